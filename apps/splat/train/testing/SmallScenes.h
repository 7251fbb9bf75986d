/// Scenes, cameras and photographs that training's tests make.
#pragma once

#include "capture/Photo.h"
#include "io/Cameras.h"
#include "scene/Scene.h"

#include <cstdint>
#include <random>

namespace vorion::splat {

/// How far apart a random scene's parameters are: each is a middle, 0 but for
/// the log scales, plus at most this much to either side.
struct SceneSpread {
  float Means = 0.8F;                       ///< world units
  float LogScale = -1.6F, LogScales = 0.6F; ///< the middle, and beside it
  float Logits = 1.5F;
};

/// \p Count Gaussians of all colours about the origin.
Scene randomScene(std::mt19937 &Random, uint32_t Count, int ShDegree,
                  const SceneSpread &Spread = {});

/// \p C 3 units from the axis that runs through the origin along y, at \p Angle
/// about it, \p Down along it, and looking across it.
Camera aroundOrigin(Camera C, double Angle, double Down);

/// What \p C sees of \p S, by the reference in fp64.
Photo photographed(const Scene &S, const Camera &C);

} // namespace vorion::splat
