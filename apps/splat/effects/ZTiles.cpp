// Lists cut into depth parts that are blended apart and merged.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (In.Options.Blending == Path::Simt)
    return {false, "the rasterizer's", false};
  return {In.Options.ZTiles > 1, fmt::format("--ztiles {}", In.Options.ZTiles)};
}

} // namespace

const Effect effects::ZTiles{.Name = "z-tiles",
                             .Kind = EffectKind::Machine,
                             .What =
                                 "a command per segment, and the kernel merge",
                             .Macro = "USE_ZTILES",
                             .Detect = detect};

} // namespace vorion::splat
