// How deep the picture is: for each pixel the sum of its weights times depths.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Depth ? Finding{true, "--depth"}
                  : Finding{false, "not requested (--depth)"};
}

} // namespace

const Effect effects::Depth{.Name = "depth",
                            .Kind = EffectKind::Observation,
                            .What = "the kernel depths_for_colors, and a "
                                    "second blending pass over the lists",
                            .Detect = detect};

} // namespace vorion::splat
