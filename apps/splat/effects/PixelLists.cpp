// What each pixel is made of: the host goes through the device's own lists.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Lists
             ? Finding{true, "--contributors or --depth-as median"}
             : Finding{false,
                       "not requested (--contributors, --depth-as median)"};
}

} // namespace

const Effect effects::PixelLists{
    .Name = "pixel-lists",
    .Kind = EffectKind::Observation,
    .What = "read-back of projected Gaussians and lists",
    .Detect = detect};

} // namespace vorion::splat
