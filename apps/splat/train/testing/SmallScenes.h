/// Scenes, cameras and photographs for the tests of training.
#pragma once

#include "capture/Photo.h"
#include "io/Cameras.h"
#include "scene/Scene.h"

#include <cstdint>
#include <random>

namespace vorion::splat {

/// The distribution of a random scene's parameters: uniform around a centre,
/// which is 0 except for the log scales, within this distance.
struct SceneSpread {
  float Means = 0.8F;                       ///< world units
  float LogScale = -1.6F, LogScales = 0.6F; ///< centre, and distance
  float Logits = 1.5F;
};

/// \p Count Gaussians of random colours around the origin.
Scene randomScene(std::mt19937 &Random, uint32_t Count, int ShDegree,
                  const SceneSpread &Spread = {});

/// \p C at 3 units from the y axis, rotated by \p Angle about it, translated by
/// \p Down along it, and looking at it.
Camera aroundOrigin(Camera C, double Angle, double Down);

/// The view \p C of \p S, rendered by the fp64 reference.
Photo photographed(const Scene &S, const Camera &C);

} // namespace vorion::splat
