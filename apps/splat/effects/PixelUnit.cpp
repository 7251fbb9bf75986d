// Tails of lists go on in the pixel unit (docs/rasterizer.md): same bits.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (In.Options.Blending == Path::Simt)
    return {false, "the rasterizer's", false};
  const TailRule &Rule = In.Options.PixelUnit;
  return {Rule.any(), "--pixel-unit " + toString(Rule)};
}

} // namespace

const Effect effects::PixelUnit{
    .Name = "pixel-unit",
    .Kind = EffectKind::Machine,
    .What =
        "conditions for handing over and a record per command; the pixel units",
    .Macro = "USE_PIXEL_UNIT",
    .Detect = detect};

} // namespace vorion::splat
