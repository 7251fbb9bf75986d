// A pinhole with OpenCV's distortion (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Optics == LensModel::OpenCv;
  return {Is, Is ? "the camera's model" : "the camera has another model", Is};
}

} // namespace

const Effect effects::OpenCvLens{
    .Name = "opencv",
    .Kind = EffectKind::Scene,
    .What = "radial, tangential and thin prism distortion",
    .Macro = "USE_OPENCV",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
