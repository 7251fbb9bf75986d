// Which way surfaces look: for each pixel the sum of its weights times normals.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Normals ? Finding{true, "--normals"}
                    : Finding{false, "not requested (--normals)"};
}

} // namespace

const Effect effects::Normals{.Name = "normals",
                              .Kind = EffectKind::Observation,
                              .What = "the kernel normals_for_colors, and a "
                                      "second blending pass over the lists",
                              .Detect = detect};

} // namespace vorion::splat
