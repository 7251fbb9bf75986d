// The full sphere (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Optics == LensModel::Equirectangular;
  return {Is, Is ? "the camera's model" : "the camera has another model", Is};
}

} // namespace

const Effect effects::EquirectangularLens{
    .Name = "equirectangular",
    .Kind = EffectKind::Scene,
    .What = "two arc tangents, and copies across the seam",
    .Macro = "USE_EQUIRECTANGULAR",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
