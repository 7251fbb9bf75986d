// Pixels that blend by the depths along their own rays, as StopThePop has it
// (Radl et al. 2024), not by those of centres: nothing pops as a camera turns.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Order == PixelOrder::Ray;
  return {Is, Is ? "--order ray" : "--order depth", Is};
}

} // namespace

const Effect effects::RayOrder{.Name = "ray-order",
                               .Kind = EffectKind::Scene,
                               .What =
                                   "the kernels ray_frames and blend_by_ray, "
                                   "which makes several passes over a list",
                               .Detect = detect,
                               .Neutral = false};

} // namespace vorion::splat
