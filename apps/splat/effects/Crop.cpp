// A window of a larger picture, beside its principal point (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (In.Options.Optics == LensModel::Equirectangular ||
      In.Options.Through != Spread::Jacobian || In.Options.Rolling)
    return {false,
            "not for full spheres, the unscented transform and rolling "
            "shutters",
            false};
  return {In.Facts.IsCrop,
          In.Facts.IsCrop ? "the principal point is outside the picture"
                          : "the principal point is in the picture",
          In.Facts.IsCrop};
}

} // namespace

const Effect effects::Crop{.Name = "crop",
                           .Kind = EffectKind::Scene,
                           .What = "means from the ray through the picture's "
                                   "middle, as sums of two floats",
                           .Macro = "USE_CROP",
                           .Detect = detect,
                           .Neutral = false,
                           .ByCamera = true};

} // namespace vorion::splat
