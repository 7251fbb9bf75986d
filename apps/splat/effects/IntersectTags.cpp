// A list entry says whether its Gaussian spans several tiles, which the
// rasterizer's memory keeps (docs/rasterizer.md); nobody else asks.

#include "effects/Registry.h"

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  return In.Options.Blending == Path::Raster
             ? Finding{true, "--path raster fetches records by the tag"}
             : Finding{false, "--path simt reads no tags"};
}

} // namespace

const Effect effects::IntersectTags{.Name = "intersect-tags",
                                    .Kind = EffectKind::Machine,
                                    .What =
                                        "the tag of each list entry and record",
                                    .Macro = "USE_INTERSECT_TAGS",
                                    .Detect = detect};

} // namespace vorion::splat
