#include "capture/Capture.h"

#include "capture/CaptureFiles.h"
#include "capture/ColmapCapture.h"
#include "capture/ForeignCapture.h"
#include "capture/Photo.h"
#include "capture/TransformsCapture.h"
#include "io/Mean.h"
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
  if (C.Views.empty())
    return Error{Path, "no view, expected at least one"};
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

/// Counts views of which something is to be said, and describes the first.
struct Noted {
  std::size_t Count = 0;
  std::string First;

  void add(const std::string &What) {
    if (Count++ == 0)
      First = What;
  }
};

/// Whether \p W x \p H pixels are those of a picture of \p C in another size,
/// whose sides may be rounded.
bool isScaled(double W, double H, const Camera &C) {
  constexpr double Tolerance = 0.05; // of a side
  const double Wanted = W * C.Height / C.Width;
  return std::abs(H - Wanted) < std::max(1.0, Tolerance * Wanted);
}

/// Looks at the picture of \p V, and scales the intrinsics to it if its size is
/// another than its camera's.
Expected<Success> fitPicture(CaptureView &V, Noted &Scaled, Noted &Turned,
                             Noted &AsStored) {
  const auto File = readRegularFile(V.Picture);
  if (!File)
    return File.error();
  auto Size = photoSize(V.Picture, *File);
  if (!Size)
    return Size.error();
  const Camera &C = V.Pose;
  const std::string Name = printable(C.Name);
  const int Orientation = photoOrientation(*File);
  if (swapsSides(Orientation) && !isScaled(Size->Width, Size->Height, C) &&
      isScaled(Size->Height, Size->Width, C)) {
    V.Orientation = Orientation;
    std::swap(Size->Width, Size->Height);
    Turned.add(Name);
  } else if (Orientation != 1) {
    AsStored.add(Name);
  }
  if (!isScaled(Size->Width, Size->Height, C))
    return Error{V.Picture,
                 fmt::format("{}x{} pixels, expected {}x{} as in its camera, "
                             "or the same picture in another size",
                             Size->Width, Size->Height, C.Width, C.Height)};
  if (Size->Width != C.Width || Size->Height != C.Height) {
    Scaled.add(fmt::format("{} from {}x{} to {}x{}", Name, C.Width, C.Height,
                           Size->Width, Size->Height));
    V.Pose = stretched(V.Pose, Size->Width, Size->Height);
  }
  return Success{};
}

Expected<Success> fitPictures(Capture &C) {
  Noted Scaled, Turned, AsStored;
  for (CaptureView &V : C.Views)
    if (auto Good = fitPicture(V, Scaled, Turned, AsStored); !Good)
      return Good;
  if (Scaled.Count > 0)
    C.Notes.push_back(
        fmt::format("intrinsics of {} scaled to their pictures: {}",
                    counted(Scaled.Count, "camera"), Scaled.First));
  if (Turned.Count > 0)
    C.Notes.push_back(
        fmt::format("{} turned by their EXIF orientation, as their cameras "
                    "are: {}",
                    counted(Turned.Count, "picture"), Turned.First));
  if (AsStored.Count > 0)
    C.Notes.push_back(fmt::format(
        "{} with an EXIF orientation used as stored, as their cameras are: {}",
        counted(AsStored.Count, "picture"), AsStored.First));
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

std::vector<float> CapturePoints::local() const {
  std::vector<float> Local(Positions.size());
  for (std::size_t I = 0; I < Local.size(); ++I)
    Local[I] = static_cast<float>(Positions[I] - Origin[I % 3]);
  return Local;
}

std::vector<Camera> Capture::poses() const {
  std::vector<Camera> Poses;
  Poses.reserve(Views.size());
  for (const CaptureView &V : Views)
    Poses.push_back(V.Pose);
  return Poses;
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

double sceneExtent(const Capture &C) {
  const CameraRing Ring = cameraRing(C);
  if (Ring.Radius != 0 || C.Points.size() == 0)
    return Ring.extent();
  std::vector<double> Distances;
  Distances.reserve(C.Points.size());
  const std::vector<float> Local = C.Points.local();
  for (std::size_t I = 0; I < Local.size(); I += 3) {
    std::array<double, 3> Way{};
    for (std::size_t K = 0; K < 3; ++K)
      Way[K] = Local[I + K] - (Ring.Centre[K] - C.Points.Origin[K]);
    Distances.push_back(std::hypot(Way[0], Way[1], Way[2]));
  }
  return medianOf(std::move(Distances));
}

bool isCapture(const std::string &Path) {
  if (findCapture(Path).has_value())
    return !Path.ends_with(".json") ||
           fs::path(Path).filename().string().starts_with("transforms");
  return foreignCapture(Path).has_value();
}

static Error noCapture(const std::string &Path) {
  constexpr const char *Wanted =
      "a folder with COLMAP's sparse/0/cameras.bin or .txt, "
      "transforms_train.json or transforms.json";
  std::error_code Ignored;
  if (auto Foreign = foreignCapture(Path))
    return *Foreign;
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
  const auto F = findCapture(Path, Options.Images.empty());
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
  constexpr std::size_t FewestToHoldOut = 3;
  if (Options.HoldOut || C.HeldOutBy.empty()) {
    const bool IsEnough = C.Views.size() >= FewestToHoldOut;
    holdOut(C, Options.HoldOut.value_or(IsEnough ? HoldOutEvery : 0));
    if (!Options.HoldOut && !IsEnough)
      C.HeldOutBy = fmt::format("none, of {}", counted(C.Views.size(), "view"));
  }
  if (C.heldOut() == C.Views.size())
    return Options.HoldOut == 1U
               ? Error{Path,
                       "--hold-out 1 leaves no view to train on, expected 0 "
                       "for none, or 2 and more",
                       ExitCode::Usage}
               : Error{Path, "no view to train on, expected at least one"};
  if (auto Good = fitPictures(C); !Good)
    return Good.error();
  const std::vector<Camera> Poses = C.poses();
  C.Points.Origin = localOrigin(
      Poses, C.Points.size() == 0
                 ? sampled(Poses.size(),
                           [&](std::size_t I) { return Poses[I].Position; })
                 : sampled(C.Points.size(),
                           [&](std::size_t I) { return C.Points.at(I); }));
  return C;
}

} // namespace vorion::splat
