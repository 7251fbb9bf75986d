// Colour that depends on the direction from which a Gaussian is seen.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  for (const Effect *Band : {&effects::Sh1, &effects::Sh2, &effects::Sh3})
    if (Band->Detect(In).Needed)
      return {true, fmt::format("{} needs the direction", Band->Name)};
  return {false, "SH degree 0 only"};
}

} // namespace

const Effect effects::ViewColor{
    .Name = "view-color",
    .Kind = EffectKind::Scene,
    .What = "normalization of the view direction, for any degree above 0",
    .Macro = "USE_VIEW_COLOR",
    .Detect = detect};

} // namespace vorion::splat
