// The projection's Jacobian is taken no further out than the rules' limits.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (In.Options.Kind != RendererKind::Splat)
    return {false, "rays have no Jacobian", false};
  if (!In.Options.Optics->HoldsSlopes)
    return {false, "this camera has no limits of x/z and y/z", false};
  if (In.Options.Rolling)
    return {true, "the camera moves during the exposure"};
  return {In.Facts.BeyondField != 0,
          fmt::format("{} of {} means at or beyond the limits of x/z and y/z",
                      In.Facts.BeyondField, In.Gaussians.size())};
}

} // namespace

const Effect effects::FieldOfView{
    .Name = "field-of-view",
    .Kind = EffectKind::Scene,
    .What = "the clamp of x/z and y/z in the Jacobian",
    .Macro = "USE_FIELD_OF_VIEW",
    .Detect = detect};

} // namespace vorion::splat
