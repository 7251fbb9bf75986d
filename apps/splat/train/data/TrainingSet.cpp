#include "train/data/TrainingSet.h"

#include "capture/Undistort.h"
#include "train/data/DepthPoints.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace vorion::splat {
namespace {

Expected<Plane> readPhoto(const std::string &Path) {
  const auto File = readRegularFile(Path);
  return File ? decodePhoto(Path, *File) : File.error();
}

/// Which pixels of \p P, the picture of \p V, count: in a mask file those that
/// are not black, by alpha those that are not transparent.
Expected<std::vector<uint8_t>> countsOf(const CaptureView &V, const Plane &P,
                                        MaskSource Source) {
  std::vector<uint8_t> Counts;
  if (Source == MaskSource::Alpha) {
    for (std::size_t I = 0; I < P.pixels(); ++I)
      Counts.push_back(P.at(I, 3) != 0 ? 1 : 0);
  } else if (!V.Mask.empty()) {
    const auto Mask = readPhoto(V.Mask);
    if (!Mask)
      return Mask.error();
    if (Mask->Width != P.Width || Mask->Height != P.Height)
      return Error{V.Mask,
                   fmt::format("{}x{} pixels, expected {}x{} as in its picture",
                               Mask->Width, Mask->Height, P.Width, P.Height)};
    for (std::size_t I = 0; I < P.pixels(); ++I)
      Counts.push_back(
          (Mask->at(I, 0) | Mask->at(I, 1) | Mask->at(I, 2)) != 0 ? 1 : 0);
  }
  return Counts;
}

/// Masked pixels are 0.
void clearMasked(TrainView &V) {
  for (std::size_t I = 0; I < V.Counts.size(); ++I)
    if (V.Counts[I] == 0)
      std::fill_n(V.Picture.Rgb.begin() + static_cast<std::ptrdiff_t>(3 * I), 3,
                  0);
}

/// \p Points: of the capture, from \p Origin.
Expected<TrainView> load(const CaptureView &V, const std::vector<float> &Points,
                         const WorldPoint &Origin, const LoadOptions &O) {
  auto Stored = readPhoto(V.Picture);
  if (!Stored)
    return Stored.error();
  Plane Full = turned(std::move(*Stored), V.Orientation);
  auto Counts = countsOf(V, Full, O.Masks);
  if (!Counts)
    return Counts.error();
  MaskedPlane Taken{std::move(Full), std::move(*Counts)};
  Camera Pose = V.Pose;
  if (O.Pictures == LensOf::Photograph)
    Pose.Optics = V.Optics;
  else if (!V.Optics.isPinhole())
    Taken = undistorted(Taken, Pose, V.Optics);
  const Plane &P = Taken.Picture;
  const int Width = shrunkSide(Pose.Width, O.Downscale);
  const int Height = shrunkSide(Pose.Height, O.Downscale);
  TrainView T{stretched(Pose, Width, Height),
              shrink(P, Width, Height, O.Background),
              shrinkCounts(Taken.Counts, P.Width, P.Height, Width, Height),
              {}};
  if (std::ranges::find(T.Counts, 0) == T.Counts.end())
    T.Counts.clear();
  else if (std::ranges::find(T.Counts, 1) == T.Counts.end())
    return Error{
        V.Mask.empty() ? V.Picture : V.Mask,
        "all pixels are masked out, expected at least one unmasked pixel"};
  clearMasked(T);
  if (O.KeepAlpha) {
    T.Alpha = shrinkAlpha(P, Width, Height);
    if (std::ranges::all_of(T.Alpha, [](uint8_t A) { return A == 255; }))
      T.Alpha.clear();
  }
  if (O.KeepDepths)
    T.Depths =
        depthPoints(relativeTo(T.Pose, Origin), Points, V.Sees, T.Counts);
  return T;
}

} // namespace

Photo over(const TrainView &V, const std::array<float, 3> &Was,
           const std::array<float, 3> &Is) {
  Photo P = V.Picture;
  for (std::size_t I = 0; I < V.Alpha.size(); ++I)
    if (V.Counts.empty() || V.Counts[I] != 0)
      for (std::size_t K = 0; K < 3; ++K) {
        const double Level =
            P.Rgb[3 * I + K] +
            (255.0 - V.Alpha[I]) * (double{Is[K]} - double{Was[K]});
        P.Rgb[3 * I + K] =
            static_cast<uint8_t>(std::clamp(std::lround(Level), 0L, 255L));
      }
  return P;
}

TrainView shrunk(const TrainView &V, int Factor) {
  const Photo &From = V.Picture;
  const int Width = shrunkSide(From.Width, Factor),
            Height = shrunkSide(From.Height, Factor);
  TrainView To{stretched(V.Pose, Width, Height),
               shrink(From, Width, Height),
               shrinkCounts(V.Counts, static_cast<std::size_t>(From.Width),
                            static_cast<std::size_t>(From.Height), Width,
                            Height),
               {}};
  clearMasked(To);
  if (!V.Alpha.empty()) {
    Photo Grey{From.Width, From.Height, {}};
    Grey.Rgb.reserve(3 * V.Alpha.size());
    for (const uint8_t A : V.Alpha)
      Grey.Rgb.insert(Grey.Rgb.end(), 3, A);
    Grey = shrink(Grey, Width, Height);
    for (std::size_t I = 0; I < Grey.pixels(); ++I)
      To.Alpha.push_back(Grey.Rgb[3 * I]);
  }
  for (DepthPoint D : V.Depths) {
    const auto Across = static_cast<uint32_t>(From.Width),
               Down = static_cast<uint32_t>(From.Height);
    const uint32_t X = D.Pixel % Across * static_cast<uint32_t>(Width) / Across,
                   Y = D.Pixel / Across * static_cast<uint32_t>(Height) / Down;
    D.Pixel = Y * static_cast<uint32_t>(Width) + X;
    if (To.Counts.empty() || To.Counts[D.Pixel] != 0)
      To.Depths.push_back(D);
  }
  std::ranges::sort(To.Depths, {}, [](const DepthPoint &D) {
    return std::pair(D.Pixel, D.Disparity);
  });
  return To;
}

std::vector<Camera> TrainingSet::cameras() const {
  std::vector<Camera> All;
  for (const auto *Views : {&Training, &HeldOut})
    for (const TrainView &V : *Views)
      All.push_back(V.Pose);
  return All;
}

std::pair<int, int> TrainingSet::largest() const {
  std::pair<int, int> Size{0, 0};
  for (const auto *Views : {&Training, &HeldOut})
    for (const TrainView &V : *Views)
      Size = {std::max(Size.first, V.Picture.Width),
              std::max(Size.second, V.Picture.Height)};
  return Size;
}

std::size_t TrainingSet::depths() const {
  std::size_t Count = 0;
  for (const TrainView &V : Training)
    Count += V.Depths.size();
  return Count;
}

Expected<TrainingSet> loadTrainingSet(const Capture &C, const LoadOptions &O) {
  TrainingSet Set;
  const std::vector<float> Points =
      O.KeepDepths ? C.Points.local() : std::vector<float>();
  for (const CaptureView &V : C.Views) {
    auto Loaded = load(V, Points, C.Points.Origin, O);
    if (!Loaded)
      return Loaded.error();
    (V.HeldOut ? Set.HeldOut : Set.Training).push_back(std::move(*Loaded));
  }
  return Set;
}

} // namespace vorion::splat
