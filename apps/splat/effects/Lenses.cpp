// Lenses of cameras that are no pinholes (docs/cameras.md): an effect for each
// record of lens/.

#include "effects/Registry.h"

#include <algorithm>
#include <vector>

namespace vorion::splat {

Finding Effect::findLens(const EffectInputs &In) const {
  const bool Is = In.Options.Optics == Lens;
  return {Is, Is ? "the camera's model" : "another camera model", Is};
}

std::span<const Effect> effects::ofLenses() {
  static const std::vector<Effect> List = [] {
    std::vector<Effect> Found;
    for (const LensModel *M : lenses::all())
      if (!M->isPinhole())
        Found.push_back({.Name = M->EffectName,
                         .Kind = EffectKind::Scene,
                         .What = M->EffectText,
                         .Macro = M->Macro,
                         .Lens = M,
                         .Neutral = false,
                         .ByCamera = true});
    return Found;
  }();
  return List;
}

const Effect *effects::lensOf(const LensModel &M) {
  const auto All = ofLenses();
  const auto At = std::ranges::find(All, &M, &Effect::Lens);
  return At == All.end() ? nullptr : &*At;
}

} // namespace vorion::splat
