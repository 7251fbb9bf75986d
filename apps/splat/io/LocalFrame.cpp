#include "io/LocalFrame.h"

#include "io/Mean.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorion::splat {
namespace {

/// Least focal length of pictures, px.
constexpr double LeastFocal = 4096;

double distance(const WorldPoint &A, const WorldPoint &B) {
  return std::hypot(A[0] - B[0], A[1] - B[1], A[2] - B[2]);
}

/// The median along each axis; there is at least one.
WorldPoint middleOf(std::span<const WorldPoint> Sample) {
  WorldPoint Middle{};
  for (std::size_t A = 0; A < 3; ++A) {
    std::vector<double> Along;
    for (const WorldPoint &P : Sample)
      Along.push_back(P[A]);
    Middle[A] = medianOf(std::move(Along));
  }
  return Middle;
}

/// Half of \p Sample is so near to \p Middle.
double radiusOf(std::span<const WorldPoint> Sample, const WorldPoint &Middle) {
  std::vector<double> Distances;
  for (const WorldPoint &P : Sample)
    Distances.push_back(distance(P, Middle));
  return medianOf(std::move(Distances));
}

/// What rounding moves a coordinate of \p P, at most.
double roundingOf(const WorldPoint &P) {
  return 0x1p-24 * std::max({std::abs(P[0]), std::abs(P[1]), std::abs(P[2])});
}

} // namespace

double pixelsLost(const std::vector<Camera> &Cameras,
                  std::span<const WorldPoint> Sample) {
  std::vector<double> Lost;
  const auto Add = [&](const WorldPoint &P, double Distance, double Focal) {
    if (Distance > 0)
      Lost.push_back(roundingOf(P) / Distance * Focal);
  };
  if (Cameras.empty() && !Sample.empty()) {
    const double Radius = radiusOf(Sample, middleOf(Sample));
    for (const WorldPoint &P : Sample)
      Add(P, Radius, LeastFocal);
  }
  for (std::size_t I = 0; I < Cameras.size();
       I += 1 + Cameras.size() / MostSampled) {
    const Camera &C = Cameras[I];
    for (const WorldPoint &P : Sample)
      if (C.Optics.Model->IsParallel)
        Add(P, 1, C.Fx);
      else
        Add(P, distance(P, C.Position), std::max({C.Fx, C.Fy, LeastFocal}));
  }
  return Lost.empty() ? 0 : medianOf(std::move(Lost));
}

WorldPoint localOrigin(const std::vector<Camera> &Cameras,
                       std::span<const WorldPoint> Sample) {
  if (!(pixelsLost(Cameras, Sample) > MostPixelsLost))
    return {};
  WorldPoint Origin = middleOf(Sample);
  const double Radius = radiusOf(Sample, Origin);
  // A multiple of a power of two that is as large as the scene.
  if (Radius > 0)
    for (double &X : Origin) {
      const double Step = std::exp2(std::floor(std::log2(Radius)));
      X = Step * std::round(X / Step);
    }
  return Origin;
}

Camera relativeTo(Camera C, const WorldPoint &Origin) {
  for (std::size_t A = 0; A < 3; ++A)
    C.Position[A] -= Origin[A];
  return C;
}

std::vector<Camera> relativeTo(std::vector<Camera> Cameras,
                               const WorldPoint &Origin) {
  for (Camera &C : Cameras)
    C = relativeTo(std::move(C), Origin);
  return Cameras;
}

} // namespace vorion::splat
