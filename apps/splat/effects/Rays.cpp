// Gaussians along the rays of pixels in place of footprints (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Kind == RendererKind::Ray;
  return {Is, Is ? "--renderer ray" : "--renderer splat", Is};
}

} // namespace

const Effect effects::Rays{
    .Name = "rays",
    .Kind = EffectKind::Scene,
    .What = "records of rays, and a quotient for each pixel and Gaussian",
    .Macro = "USE_RAYS",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
