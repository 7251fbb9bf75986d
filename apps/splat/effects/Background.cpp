// The colour that shows through what the Gaussians leave open. Without one the
// blended pixels are the picture.

#include "effects/Registry.h"

#include <algorithm>
#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const auto &B = In.Options.Background;
  // A NaN is no zero, and -0 is one.
  return {!std::ranges::all_of(B, [](float V) { return V == 0; }),
          fmt::format("--background {:g},{:g},{:g}", B[0], B[1], B[2])};
}

} // namespace

const Effect effects::Background{
    .Name = "background",
    .Kind = EffectKind::Scene,
    .What = "the kernel resolve, a pass over all pixels",
    .Macro = "USE_BACKGROUND",
    .Detect = detect};

} // namespace vorion::splat
