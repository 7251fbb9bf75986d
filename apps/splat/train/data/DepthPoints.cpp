#include "train/data/DepthPoints.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace vorion::splat {

std::vector<DepthPoint> depthPoints(const Camera &Pose,
                                    const std::vector<float> &Points,
                                    const std::vector<uint32_t> &Sees,
                                    const std::vector<uint8_t> &Counts) {
  const auto R = Pose.worldToCameraRotation();
  const auto T = Pose.worldToCameraTranslation();
  std::vector<DepthPoint> Found;
  for (const uint32_t I : Sees) {
    std::array<double, 3> P = T;
    for (std::size_t Row = 0; Row < 3; ++Row)
      for (std::size_t K = 0; K < 3; ++K)
        P[Row] += R[3 * Row + K] * Points[3 * std::size_t{I} + K];
    const double X = Pose.Fx * P[0] / P[2] + Pose.Cx;
    const double Y = Pose.Fy * P[1] / P[2] + Pose.Cy;
    const auto Disparity = static_cast<float>(1 / P[2]);
    // A NaN is none of these.
    if (!(Disparity > 0 && std::isfinite(Disparity) && X >= 0 &&
          X < Pose.Width && Y >= 0 && Y < Pose.Height))
      continue;
    const auto Pixel =
        static_cast<uint32_t>(Y) * static_cast<uint32_t>(Pose.Width) +
        static_cast<uint32_t>(X);
    if (Counts.empty() || Counts[Pixel] != 0)
      Found.push_back({Pixel, Disparity});
  }
  std::ranges::sort(Found, {}, [](const DepthPoint &P) {
    return std::pair(P.Pixel, P.Disparity);
  });
  return Found;
}

} // namespace vorion::splat
