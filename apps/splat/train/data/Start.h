/// The initial Gaussians of training.
#pragma once

#include "capture/Capture.h"
#include "io/LocalFrame.h"
#include "scene/Scene.h"

#include <cstdint>
#include <string>
#include <vector>

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
/// They are uniformly distributed within this distance from their centre along
/// each axis, where cameras are about 4 units away.
inline constexpr double RandomReach = 1.3;

/// The cube of the random points of \p C. Its centre is the origin if most
/// views see it, as in synthetic captures, or if the cameras look at no common
/// point. Otherwise it is that point. Its size follows the median distance of
/// the cameras, in powers of two.
struct RandomCube {
  WorldPoint Centre{};
  double Reach = RandomReach;
  std::size_t SeenBy = 0; ///< number of views that contain the centre

  /// For messages: "the origin", or coordinates.
  std::string centreText() const;
};
RandomCube randomCube(const Capture &C);

/// Positions of the scene of \p C for SceneUnit.h: of its points, or the centre
/// of the random ones if most views see it.
std::vector<WorldPoint> sampleOf(const Capture &C);

/// An isotropic Gaussian at each point of \p C, or at random points if it has
/// none. The scale is the mean distance to the three nearest points (as in the
/// text of Kerbl et al. 2023; their code uses the root mean square), the colour
/// that of the point (grey for random points). Measured from the origin of the
/// capture's points. The same on every host.
Scene startingScene(const Capture &C, const StartOptions &O);

} // namespace vorion::splat
