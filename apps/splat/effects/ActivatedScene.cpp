// Exponentials, logistic functions and normalised quaternions depend on no
// camera: where several pictures are drawn, they are computed once.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (effects::Needles.Detect(In).Needed)
    return {false, "the effect needles needs unnormalized quaternions", false};
  return {In.Views > 1, fmt::format("{} {} of the scene", In.Views,
                                    In.Views == 1 ? "picture" : "pictures")};
}

} // namespace

const Effect effects::ActivatedScene{
    .Name = "activated-scene",
    .Kind = EffectKind::Machine,
    .What = "the kernel activate_scene, once; project loads what it wrote",
    .Macro = "USE_ACTIVATED_SCENE",
    .Detect = detect,
    .ByCamera = true};

} // namespace vorion::splat
