#include "capture/Capture.h"

#include "capture/CaptureFiles.h"
#include "capture/ColmapCapture.h"
#include "capture/Photo.h"
#include "capture/TransformsCapture.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Letters.h"
#include "vorion/support/Printable.h"
#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <ranges>
#include <set>

namespace vorion::splat {
namespace {

namespace fs = std::filesystem;

/// 1st, 2nd, 3rd, 4th.
std::string ordinal(unsigned N) {
  const bool Teens = N % 100 > 10 && N % 100 < 14;
  const unsigned Last = Teens ? 0 : N % 10;
  return fmt::format("{}{}", N,
                     Last == 1   ? "st"
                     : Last == 2 ? "nd"
                     : Last == 3 ? "rd"
                                 : "th");
}

/// Holds out every \p Every-th view, or none.
void holdOut(Capture &C, unsigned Every) {
  for (std::size_t I = 0; I < C.Views.size(); ++I)
    C.Views[I].HeldOut = Every != 0 && I % Every == 0;
  C.HeldOutBy = Every == 0
                    ? "none, by option"
                    : fmt::format("every {} in order of names", ordinal(Every));
}

/// What the options ask of masks.
Expected<Success> checkMasks(const std::string &Path, const Capture &C,
                             const CaptureOptions &Options) {
  if (Options.Masks == MaskSource::Files && C.masked() == 0)
    return Error{Path, "no masks, expected masks/NAME.png for each picture "
                       "NAME, or mask_path in the frames"};
  return Success{};
}

/// Whether the user means \p Name by \p Wanted.
bool matchesName(const std::string &Name, const std::string &Wanted) {
  const fs::path Path(Name);
  return Name == Wanted || Path.filename() == Wanted || Path.stem() == Wanted ||
         // Synthetic captures name pictures without their ending.
         (!Path.has_extension() && Path.filename() == fs::path(Wanted).stem());
}

Expected<Success> exclude(const std::string &Path, Capture &C,
                          const std::vector<std::string> &Names) {
  for (const std::string &Name : Names)
    if (std::erase_if(C.Views, [&](const CaptureView &V) {
          return matchesName(V.Pose.Name, Name);
        }) == 0) {
      const auto Known = std::views::transform(
          C.Views, [](const CaptureView &V) { return V.Pose.Name; });
      return Error{Path,
                   fmt::format("no picture {} to exclude, expected one of the "
                               "capture's{}",
                               Name, didYouMean(Name, Known)),
                   ExitCode::Usage};
    }
  if (C.Views.size() < 2)
    return Error{Path, fmt::format("{}, expected at least two",
                                   counted(C.Views.size(), "view"))};
  return Success{};
}

/// That no two of \p Views are the same picture, under whatever names: it would
/// be trained on several times, and take that much memory.
Expected<Success> checkOnce(const std::string &Path,
                            const std::vector<CaptureView> &Views) {
  std::set<std::string> Pictures;
  for (const CaptureView &V : Views)
    if (!Pictures.insert(fs::path(V.Picture).lexically_normal().string())
             .second)
      return Error{Path,
                   fmt::format("duplicate picture {}, expected unique names",
                               printable(V.Pose.Name))};
  return Success{};
}

Expected<Success> checkPicture(const CaptureView &V) {
  const auto File = readRegularFile(V.Picture);
  if (!File)
    return File.error();
  const auto Size = photoSize(V.Picture, *File);
  if (!Size)
    return Size.error();
  if (Size->Width != V.Pose.Width || Size->Height != V.Pose.Height)
    return Error{V.Picture,
                 fmt::format("{}x{} pixels, expected {}x{} as in its camera",
                             Size->Width, Size->Height, V.Pose.Width,
                             V.Pose.Height)};
  return Success{};
}

} // namespace

std::string_view name(CaptureFormat F) {
  constexpr std::array<std::string_view, 4> Names{
      "colmap-text", "colmap-binary", "nerf-synthetic", "transforms"};
  return Names[static_cast<std::size_t>(F)];
}

std::size_t Capture::heldOut() const {
  return static_cast<std::size_t>(
      std::ranges::count(Views, true, &CaptureView::HeldOut));
}

std::size_t Capture::masked() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      Views, [](const CaptureView &V) { return !V.Mask.empty(); }));
}

std::size_t Capture::distorted() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(Views, [](const CaptureView &V) {
        return !V.Optics.isPinhole() || V.Optics.Shutter;
      }));
}

std::size_t Capture::photographsAlone() const {
  return static_cast<std::size_t>(
      std::ranges::count_if(Views, [](const CaptureView &V) {
        return V.Optics.Model->CoversSphere || V.Optics.Shutter;
      }));
}

CameraRing cameraRing(const Capture &C) {
  CameraRing Ring;
  double Count = 0;
  for (const CaptureView &V : C.Views)
    if (!V.HeldOut) {
      Count += 1;
      for (std::size_t K = 0; K < 3; ++K)
        Ring.Centre[K] += V.Pose.Position[K];
    }
  for (double &V : Ring.Centre)
    V /= Count;
  for (const CaptureView &V : C.Views)
    if (!V.HeldOut) {
      double Squares = 0;
      for (std::size_t K = 0; K < 3; ++K) {
        const double D = V.Pose.Position[K] - Ring.Centre[K];
        Squares += D * D;
      }
      Ring.Radius = std::max(Ring.Radius, std::sqrt(Squares));
    }
  // Poses that are the same differ by the rounding of their inverses.
  const auto [X, Y, Z] = Ring.Centre;
  if (Ring.Radius <=
      std::numeric_limits<float>::epsilon() * std::hypot(X, Y, Z))
    Ring.Radius = 0;
  return Ring;
}

bool isCapture(const std::string &Path) {
  return findCapture(Path).has_value() &&
         (!Path.ends_with(".json") ||
          fs::path(Path).filename().string().starts_with("transforms"));
}

static Error noCapture(const std::string &Path) {
  constexpr const char *Wanted =
      "a folder with COLMAP's sparse/0/cameras.bin or .txt, "
      "transforms_train.json or transforms.json";
  std::error_code Ignored;
  if (!fileExists(Path))
    return {Path,
            fmt::format("no such folder, expected a capture: {}", Wanted)};
  if (fs::is_directory(Path, Ignored))
    return {Path, fmt::format("not a capture, expected {}", Wanted)};
  return otherKindAt(Path, Wanted, "not a folder, expected a capture");
}

Expected<CaptureCameras> readCaptureCameras(const std::string &Path,
                                            LensOf Of) {
  const auto F = findCameras(Path);
  if (!F)
    return noCapture(Path);
  CaptureCameras C;
  C.Format = F->Format;
  if (F->isColmap()) {
    if (auto Added = addColmapCameras(*F, Of, C); !Added)
      return Added.error();
  } else {
    const fs::path Test = fs::path(Path) / "transforms_test.json";
    auto Added = addTransformsCameras(F->Model, Of, C);
    if (Added && F->Format == CaptureFormat::NerfSynthetic && fileExists(Test))
      Added = addTransformsCameras(Test, Of, C);
    if (!Added)
      return Added.error();
  }
  std::ranges::sort(C.Cameras, {}, &Camera::Name);
  return C;
}

std::vector<std::string> captureFiles(const std::string &Path) {
  const auto F = findCameras(Path);
  if (!F)
    return {Path};
  std::vector<fs::path> Files;
  if (F->isColmap()) {
    addColmapFiles(*F, Files);
  } else {
    addTransformsFiles(F->Model, Files);
    if (F->Format == CaptureFormat::NerfSynthetic)
      addTransformsFiles(fs::path(Path) / "transforms_test.json", Files);
  }
  std::vector<std::string> Named;
  for (const fs::path &File : Files)
    if (fileExists(File))
      Named.push_back(File.string());
  return Named;
}

Expected<Capture> readCapture(const std::string &Path,
                              const CaptureOptions &Options) {
  const auto F = findCapture(Path);
  if (!F)
    return noCapture(Path);
  Capture C;
  C.Format = F->Format;
  const fs::path Test = fs::path(Path) / "transforms_test.json";
  const bool OwnTest =
      F->Format == CaptureFormat::NerfSynthetic && fileExists(Test);
  Expected<Success> Read = Success{};
  if (F->isColmap())
    Read = readColmap(*F, Options, C);
  else
    Read = readTransforms(F->Model, OwnTest ? ViewSet::Train : ViewSet::All,
                          Options, C);
  if (Read && OwnTest)
    Read = readTransforms(Test, ViewSet::Test, Options, C);
  if (Read)
    Read = exclude(Path, C, Options.Exclude);
  if (Read)
    Read = checkMasks(Path, C, Options);
  if (!Read)
    return Read.error();

  std::ranges::sort(C.Views, {}, [](const CaptureView &V) -> const auto & {
    return V.Pose.Name;
  });
  if (auto Once = checkOnce(Path, C.Views); !Once)
    return Once.error();
  if (Options.HoldOut || C.HeldOutBy.empty())
    holdOut(C, Options.HoldOut.value_or(HoldOutEvery));
  if (C.heldOut() == C.Views.size())
    return Options.HoldOut == 1U
               ? Error{Path,
                       "--hold-out 1 leaves no view to train on, expected 0 "
                       "for none, or 2 and more",
                       ExitCode::Usage}
               : Error{Path, "no view to train on, expected at least one"};
  for (const CaptureView &V : C.Views)
    if (auto Good = checkPicture(V); !Good)
      return Good.error();
  return C;
}

} // namespace vorion::splat
