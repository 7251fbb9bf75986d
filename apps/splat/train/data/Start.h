/// The initial Gaussians of training.
#pragma once

#include "capture/Capture.h"
#include "scene/Scene.h"

#include <cstdint>

namespace vorion::splat {

struct StartOptions {
  uint64_t Seed = 0;
  int ShDegree = 3;
  /// Number of random points, and maximum number of the capture's points
  /// (evenly sampled from their list).
  std::size_t Most = 0;
  double Opacity = 0.1;
  double Scale = 1; ///< factor of the neighbours' distance
};

/// Number of random points for captures without points (VORION: synthetic
/// captures).
inline constexpr std::size_t RandomPoints = 100000;
/// They are uniformly distributed within this distance from the origin along
/// each axis.
inline constexpr double RandomReach = 1.3;

/// Number of views of \p C that contain the centre of the random points.
std::size_t viewsOfRandomPoints(const Capture &C);

/// An isotropic Gaussian at each point of \p C, or at random points if it has
/// none. The scale is the mean distance to the three nearest points (as in the
/// text of Kerbl et al. 2023; their code uses the root mean square), the colour
/// that of the point (grey for random points). The same on every host.
Scene startingScene(const Capture &C, const StartOptions &O);

} // namespace vorion::splat
