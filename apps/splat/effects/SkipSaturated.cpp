// Saturated pixels get no lane slot in the rasterizer: same bits.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Options.SkipSaturated
             ? Finding{true, "--skip-saturated"}
             : Finding{false, "not requested (--skip-saturated)"};
}

} // namespace

const Effect effects::SkipSaturated{.Name = "skip-saturated",
                                    .Kind = EffectKind::Machine,
                                    .What = "a bit of vr_options",
                                    .Detect = detect};

} // namespace vorion::splat
