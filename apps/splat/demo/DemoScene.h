/// The project's own scene: a still life with view-dependent colour.
#pragma once

#include "io/Cameras.h"
#include "scene/Scene.h"

#include <vector>

namespace vorion::splat::demo {

inline constexpr int DefaultGaussians = 42000;
inline constexpr int FewestGaussians = 1000;
inline constexpr int MostGaussians = 2000000;

/// A torus knot, balls and a ring on a tiled floor under a lamp and a sky:
/// about \p Gaussians flat Gaussians of degree 3 on the surfaces. The same
/// number always gives the same scene.
Scene makeScene(int Gaussians);

/// Views front, close and above, 960x544.
std::vector<Camera> makeCameras();

} // namespace vorion::splat::demo
