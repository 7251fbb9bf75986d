// A camera that moves while it exposes its picture (docs/cameras.md).

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const bool Is = In.Options.Rolling;
  return {Is, Is ? "the camera moves during the exposure" : "global shutter",
          Is};
}

} // namespace

const Effect effects::RollingShutter{
    .Name = "rolling-shutter",
    .Kind = EffectKind::Scene,
    .What = "the exposure time of each mean by Newton's method, and the camera "
            "pose at that time",
    .Macro = "USE_ROLLING_SHUTTER",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
