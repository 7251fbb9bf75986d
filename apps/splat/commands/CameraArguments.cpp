#include "commands/CameraArguments.h"

#include "cameras/CameraFile.h"
#include "cameras/GoodView.h"
#include "cameras/Motion.h"
#include "commands/Usage.h"
#include "picture/SceneUnit.h"
#include "vorion/support/CommandLine.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <utility>

namespace vorion::splat {
namespace {

/// Width and height; the height is 0 if only the width is given.
Expected<std::pair<int, int>> parseSize(const std::string &Text) {
  int Width = 0, Height = 0, End = 0, Whole = 0;
  static_cast<void>(
      std::sscanf(Text.c_str(), "%5d%nx%5d%n", &Width, &End, &Height, &Whole));
  const auto Fits = [](int Side) { return Side >= 1 && Side <= MaxImageSize; };
  if (static_cast<std::size_t>(Whole != 0 ? Whole : End) != Text.size() ||
      !Fits(Width) || (Whole != 0 && !Fits(Height)))
    return usage(fmt::format("--size {}: expected WIDTH or WIDTHxHEIGHT of 1 "
                             "to {} pixels each",
                             Text, MaxImageSize));
  return std::pair(Width, Height);
}

std::optional<Vector> parseUp(const std::string &Text) {
  if (Text.empty())
    return std::nullopt;
  Vector Up{};
  Up[static_cast<std::size_t>(Text.back() - 'x')] = Text.size() == 2 ? -1 : 1;
  return Up;
}

bool asksForAll(const CameraArguments &A) {
  return A.Views.empty() || (A.Views.size() == 1 && A.Views.front() == "all");
}

/// What is up, if the options or a file's cameras say so.
std::optional<Vector> givenUp(const CameraArguments &A,
                              const std::vector<Camera> &Cameras) {
  if (const auto Up = parseUp(A.Up))
    return Up;
  return A.File.empty() ? std::nullopt : upOf(Cameras);
}

/// What the cameras go around, and about which axis.
std::pair<Vector, Vector> pivotOf(const CameraArguments &A,
                                  const std::vector<Camera> &Cameras,
                                  const SceneFile &S) {
  const std::optional<Vector> Up = givenUp(A, Cameras);
  std::optional<Vector> Centre;
  if (!A.File.empty())
    Centre = lookedAt(Cameras);
  if (!Up || !Centre) {
    const SceneFocus F = focusOf(S, Up);
    return {Centre.value_or(F.Centre), F.Up};
  }
  return {*Centre, *Up};
}

} // namespace

void addCameraOptions(CLI::App &App, CameraArguments &A, bool Several) {
  const HelpGroup Group(App, "Cameras");
  takesFile(App.add_option(
                "--cameras", A.File,
                "Views: INRIA's cameras.json, transforms.json, nerfstudio's "
                "camera path, or a folder with COLMAP's cameras (default: an "
                "automatic view that covers much of the scene)"),
            {".json", ".bin", ".txt"});
  App.add_flag(
         "--distorted", A.Distorted,
         "For a capture, render with the lens distortion of the photographs "
         "(default: with the undistorted cameras that training uses)")
      ->needs("--cameras");
  if (Several) {
    addSizeOption(App, A);
    App.add_option(
           "--orbit", A.Orbit,
           "Render N views on an orbit, from the first view on, around the "
           "point that the cameras look at, or around the scene's centre")
        ->option_text("N")
        ->check(isBetween(1, 9999));
    App.add_option("--frames", A.Frames,
                   "Render N views along a smooth path through the views")
        ->option_text("N")
        ->check(isBetween(2, 9999))
        ->excludes("--orbit");
  }
  App.add_option("--up", A.Up,
                 fmt::format("Up direction of the scene, for {} and for an "
                             "automatic view (default: that of the cameras, of "
                             "the file, or estimated from the scene)",
                             Several ? "--orbit" : "navigation"))
      ->check(isOneOf({"x", "-x", "y", "-y", "z", "-z"}));
}

void addSizeOption(CLI::App &App, CameraArguments &A) {
  const HelpGroup Group(App, "Cameras");
  App.add_option("--size", A.Size,
                 fmt::format("Resolution, at the cameras' horizontal field of "
                             "view; a WIDTH alone keeps the aspect ratio "
                             "(default: the cameras', or {})",
                             DefaultSize))
      ->option_text("WIDTH[xHEIGHT]");
}

Expected<std::vector<Camera>> allCameras(const CameraArguments &A,
                                         const SceneFile &S) {
  const auto Size = parseSize(A.Size.empty() ? DefaultSize : A.Size);
  if (!Size)
    return Size.error();
  std::vector<Camera> Cameras;
  if (A.File.empty()) {
    if (!asksForAll(A))
      return usage("--view names a camera, expected --cameras");
    // The farther near plane of the two rules.
    Cameras = {goodView(S.Gaussians, focusOf(S, parseUp(A.Up)), Size->first,
                        Size->second != 0 ? Size->second
                                          : std::max(1, Size->first * 9 / 16),
                        nearLimit(Rules::Inria))};
  } else {
    auto Read = readCameraFile(A.File, A.Distorted ? LensOf::Photograph
                                                   : LensOf::Undistorted);
    if (!Read)
      return Read.error();
    Cameras = std::move(Read->Cameras);
    if (!A.Size.empty())
      for (Camera &C : Cameras)
        C = Size->second != 0 ? resized(std::move(C), Size->first, Size->second)
                              : resized(std::move(C), Size->first);
  }
  if (A.Orbit == 0 && A.Frames == 0)
    return Cameras;
  std::vector<Camera> Keys = Cameras;
  if (!asksForAll(A)) {
    auto Selected = selectCameras(A.File, Cameras, A.Views);
    if (!Selected)
      return Selected;
    Keys = std::move(*Selected);
  }
  if (A.Orbit != 0) {
    const auto [Centre, Up] = pivotOf(A, Cameras, S);
    return orbit(Keys.front(), Centre, Up, A.Orbit);
  }
  if (Keys.size() < 2)
    return usage(
        "--frames needs several views, expected --cameras with at least two");
  return alongPath(Keys, A.Frames);
}

Vector upOf(const CameraArguments &A, const std::vector<Camera> &Cameras,
            const SceneFile &S) {
  const auto Given = givenUp(A, Cameras);
  return Given ? *Given : focusOf(S).Up;
}

/// Those of \p All, the cameras of \p A, that --view selects.
static Expected<std::vector<Camera>> selected(const CameraArguments &A,
                                              std::vector<Camera> All) {
  if (A.Orbit != 0 || A.Frames != 0)
    return All;
  if (A.Views.empty()) {
    All.resize(1);
    return All;
  }
  if (asksForAll(A))
    return All;
  return selectCameras(A.File, All, A.Views);
}

Expected<std::vector<Camera>> chooseCameras(const CameraArguments &A,
                                            const SceneFile &S) {
  auto All = allCameras(A, S);
  return All ? selected(A, std::move(*All)) : All;
}

Expected<std::vector<Camera>> camerasToDraw(const CameraArguments &A,
                                            SceneFile &S, Rules Convention,
                                            std::optional<float> &Near) {
  auto All = allCameras(A, S);
  if (!All)
    return All;
  prepareToDraw(S.Gaussians, *All, Convention, Near);
  return selected(A, std::move(*All));
}

} // namespace vorion::splat
