#include "commands/CameraArguments.h"
#include "commands/Commands.h"
#include "commands/DeviceArguments.h"
#include "commands/MeshArguments.h"
#include "commands/PictureOptions.h"
#include "commands/SceneArguments.h"
#include "io/Cameras.h"
#include "picture/SceneUnit.h"
#include "render/MeshRules.h"
#include "view/Server.h"
#include "view/Session.h"
#include "vorion/support/CommandLine.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>
#include <malloc.h>
#include <memory>
#include <string>
#include <utility>

namespace vorion::splat {

namespace {

struct ViewArguments {
  SceneArguments Scene;
  CameraArguments Cameras;
  MeshArguments Mesh;
  std::string Device, Kernels, Size;
  int Port = 0;
};

/// Reads WIDTHxHEIGHT, or nothing.
Expected<std::optional<std::pair<int, int>>>
parseSize(const std::string &Text) {
  if (Text.empty())
    return std::optional<std::pair<int, int>>();
  int Width = 0, Height = 0, End = 0;
  const int Read =
      std::sscanf(Text.c_str(), "%4dx%4d%n", &Width, &Height, &End);
  const auto Fits = [](int Side) { return Side >= 16 && Side <= MostViewed; };
  if (Read != 2 || static_cast<std::size_t>(End) != Text.size() ||
      !Fits(Width) || !Fits(Height))
    return Error{"",
                 fmt::format("--size {}: expected WIDTHxHEIGHT of 16 to {} "
                             "pixels each",
                             Text, MostViewed),
                 ExitCode::Usage};
  return std::optional(std::pair(Width, Height));
}

Expected<Success> run(const ViewArguments &A, const DeviceOptions &Machine) {
  // A picture's memory goes back to the system with it. Else every thread that
  // has answered keeps some, which grows for hundreds of frames.
  mallopt(M_MMAP_THRESHOLD, 1 << 17);
  const auto Size = parseSize(A.Size);
  if (!Size)
    return Size.error();
  // The option --axes is about the first scene.
  SceneArguments Dropped = A.Scene;
  Dropped.Axes.clear();
  Session::Setup S{.Device = A.Device,
                   .Kernels = A.Kernels,
                   .Machine = Machine,
                   .Reading = Dropped.Options,
                   .ReadingWords = wordsOf(Dropped),
                   .Cameras = {},
                   .Size = *Size};
  auto File = loadScene(A.Scene);
  if (!File)
    return File.error();
  warnOfRays(File->DrawnAs, A.Scene.Path);
  const auto OwnMesh = loadOwnMesh(A.Scene, *File);
  if (!OwnMesh)
    return OwnMesh.error();
  auto AddedMesh = loadAddedMesh(A.Mesh);
  if (!AddedMesh)
    return AddedMesh.error();
  auto Cameras = allCameras(A.Cameras, *File);
  if (!Cameras)
    return Cameras.error();
  S.ThroughLens = std::ranges::any_of(
      *Cameras, [](const Camera &C) { return !C.Optics.isPinhole(); });
  // Of a capture, the page may switch to the lenses that photographs have, but
  // these show no mesh.
  CameraArguments OfPhotographs = A.Cameras;
  OfPhotographs.Distorted |= !*OwnMesh && !*AddedMesh;
  auto Photographs = allCameras(OfPhotographs, *File);
  S.Cameras = std::move(Photographs ? *Photographs : *Cameras);
  // Who looks around does so at one moment.
  for (Camera &C : S.Cameras)
    C.Optics.Shutter.reset();
  std::optional<float> Near;
  prepareToDraw(File->Gaussians, S.Cameras, Rules::Inria, Near);
  const Vector Up = upOf(A.Cameras, S.Cameras, *File);
  const std::filesystem::path Path(A.Scene.Path);
  std::string Name = printable(
      (Path.has_filename() ? Path : Path.parent_path()).filename().string());
  ShownScene First{.Name = std::move(Name),
                   .Path = A.Scene.Path,
                   .Words = wordsOf(A.Scene),
                   .File = std::move(*File),
                   .Up = Up,
                   .Near = Near,
                   .OwnMesh = *OwnMesh,
                   .AddedMesh = {.Name = A.Mesh.File,
                                 .Path = A.Mesh.File,
                                 .Triangles = std::move(*AddedMesh)},
                   .Light = A.Mesh.Light};
  joinMeshes(First);
  if (First.Light && !First.Surface)
    return lightWithoutMesh();
  for (const Camera &C : S.Cameras) {
    RenderOptions O;
    O.Surface = First.Surface;
    O.Optics = C.Optics.Model;
    if (auto Checked = checkMeshCamera(O, A.Cameras.File); !Checked)
      return Checked;
  }
  const auto Shown = Session::open(std::move(S), std::move(First));
  if (!Shown)
    return Shown.error();
  const auto Listening = listenFor(A.Port, **Shown);
  if (!Listening)
    return Listening.error();
  (*Listening)
      ->serve(
          [&] {
            printOut("splat view: {}\n", (*Listening)->address());
            printNote("open this address in a browser on this computer; Ctrl-C "
                      "exits\n");
            // Who waits for the address may read it from a pipe.
            std::fflush(stdout);
          },
          [&] { (*Shown)->giveUp(); });
  return Success{};
}

} // namespace

Runner addView(CLI::App &App) {
  auto A = std::make_shared<ViewArguments>();
  addSceneOptions(App, A->Scene);
  A->Scene.KeepsMeshes = true;
  addCameraOptions(App, A->Cameras, /*Several=*/false);
  addMeshOptions(App, A->Mesh);
  App.add_option("--port", A->Port,
                 "TCP port on 127.0.0.1 (default 0: any free port)")
      ->check(isBetween(0, 65535));
  App.add_option(
         "--size", A->Size,
         "Resolution of a picture while the camera is at rest (default: that "
         "of the window)")
      ->option_text("WIDTHxHEIGHT");
  addDeviceOption(App, A->Device);
  addKernelsOption(App, A->Kernels);
  return [A](const DeviceOptions &Machine) { return run(*A, Machine); };
}

} // namespace vorion::splat
