/// The Gaussians that training starts from.
#pragma once

#include "capture/Capture.h"
#include "scene/Scene.h"

#include <cstdint>

namespace vorion::splat {

struct StartOptions {
  uint64_t Seed = 0;
  int ShDegree = 3;
  /// Of random points, and at most so many of the capture's (evenly spread
  /// over their list).
  std::size_t Most = 0;
  double Opacity = 0.1;
  double Scale = 1; ///< times the neighbours' distance
};

/// Random points where a capture has none (VORION: synthetic captures).
inline constexpr std::size_t RandomPoints = 100000;
/// They are uniform within this of the origin along each axis.
inline constexpr double RandomReach = 1.3;

/// Views of \p C in whose picture the middle of the random points lies.
std::size_t viewsOfRandomPoints(const Capture &C);

/// A round Gaussian at each point of \p C, or at random points where it has
/// none: scale by the mean distance to the three nearest others (Kerbl et al.
/// 2023 say so; their code takes the root of the mean square), colour that of
/// the point (grey where random). The same on every host.
Scene startingScene(const Capture &C, const StartOptions &O);

} // namespace vorion::splat
