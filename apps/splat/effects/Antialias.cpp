// Compensation of the opacity for the dilation (Mip-Splatting, gsplat's and
// INRIA's antialiased rules).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const RenderOptions &O = In.Options;
  return {
      O.Antialiased,
      O.AntialiasedBy.empty()
          ? "neither the scene's file nor --antialiased selects it selects it"
          : O.AntialiasedBy};
}

} // namespace

const Effect effects::Antialias{
    .Name = "antialias",
    .Kind = EffectKind::Scene,
    .What = "opacity times the square root of the ratio of determinants",
    .Macro = "USE_ANTIALIAS",
    .Detect = detect,
    .Neutral = false};

} // namespace vorion::splat
