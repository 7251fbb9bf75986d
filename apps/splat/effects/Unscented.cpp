// The unscented transform in place of the Jacobian (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Through == Spread::Unscented;
  return {Is, Is ? "--projection unscented" : "--projection jacobian", Is};
}

} // namespace

const Effect effects::Unscented{.Name = "unscented",
                                .Kind = EffectKind::Scene,
                                .What = "seven sigma points per Gaussian",
                                .Macro = "USE_UNSCENTED",
                                .Detect = detect,
                                .Neutral = false,
                                .ByCamera = true};

} // namespace vorion::splat
