// Alpha is at most 0.99. The cores' kernel only: the rasterizer's lanes clamp
// in hardware.

#include "effects/Registry.h"
#include "scene/Activation.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

/// Logits within this of the threshold count as beyond it: activation rounds
/// the opacity once. falloff.cl never exceeds 1.
constexpr float LogitSlack = 1e-5F;

Finding detect(const EffectInputs &In) {
  if (In.Options.Blending == Path::Raster)
    return {false, "in the lanes of the rasterizer", false};
  if (In.Options.Exponential != ExpUnit::Exact)
    return {true,
            fmt::format("--exp {} may exceed 1", name(In.Options.Exponential))};
  const float Limit = opacityLogit(0.99);
  return {!(In.Facts.MostLogit < Limit - LogitSlack),
          fmt::format("largest logit of an opacity {:.6g}, of 0.99 {:.6g}",
                      In.Facts.MostLogit, Limit)};
}

} // namespace

const Effect effects::AlphaClamp{.Name = "alpha-clamp",
                                 .Kind = EffectKind::Scene,
                                 .What = "alpha's minimum with 0.99",
                                 .Macro = "USE_ALPHA_CLAMP",
                                 .Detect = detect};

} // namespace vorion::splat
