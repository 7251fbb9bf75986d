/// Whether fp32 holds the coordinates of a scene, and the origin from which it
/// does.
#pragma once

#include "io/Cameras.h"

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace vorion::splat {

using WorldPoint = std::array<double, 3>;

/// Most of positions and of cameras that are sampled.
inline constexpr std::size_t MostSampled = 1000;

/// Of \p Count positions, of which At(I) is one, at most MostSampled.
template <typename Function>
std::vector<WorldPoint> sampled(std::size_t Count, Function At) {
  std::vector<WorldPoint> Sample;
  for (std::size_t I = 0; I < Count; I += 1 + Count / MostSampled)
    Sample.push_back(At(I));
  return Sample;
}

/// By how many pixels rounding to fp32 may move the positions \p Sample in
/// pictures of \p Cameras: the median. Pictures count as at least 4096 px of
/// focal length, because a scene outlives its photographs. Without cameras, as
/// seen from as far as half of the positions are from their middle.
double pixelsLost(const std::vector<Camera> &Cameras,
                  std::span<const WorldPoint> Sample);

/// What pixelsLost() may be where positions are fp32 in the caller's frame.
inline constexpr double MostPixelsLost = 0.01;

/// The origin of the frame in which positions near \p Sample are fp32: 0, the
/// caller's, if no more than MostPixelsLost are lost there. Otherwise the
/// middle of \p Sample, in which numbers have few digits.
WorldPoint localOrigin(const std::vector<Camera> &Cameras,
                       std::span<const WorldPoint> Sample);

/// \p C in the frame with the origin \p Origin.
Camera relativeTo(Camera C, const WorldPoint &Origin);
std::vector<Camera> relativeTo(std::vector<Camera> Cameras,
                               const WorldPoint &Origin);

} // namespace vorion::splat
