// Parallel rays (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Optics == LensModel::Orthographic;
  return {Is, Is ? "the camera's model" : "the camera has another model", Is};
}

} // namespace

const Effect effects::OrthographicLens{.Name = "orthographic",
                                       .Kind = EffectKind::Scene,
                                       .What = "no quotient by the depth",
                                       .Macro = "USE_ORTHOGRAPHIC",
                                       .Detect = detect,
                                       .Neutral = false,
                                       .ByCamera = true};

} // namespace vorion::splat
