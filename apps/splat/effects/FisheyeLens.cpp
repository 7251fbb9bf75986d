// OpenCV's fisheye (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Optics == LensModel::Fisheye;
  return {Is, Is ? "the camera's model" : "the camera has another model", Is};
}

} // namespace

const Effect effects::FisheyeLens{
    .Name = "fisheye",
    .Kind = EffectKind::Scene,
    .What = "an arc tangent and a polynomial of the angle",
    .Macro = "USE_FISHEYE",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
