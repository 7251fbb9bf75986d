// Gaussians whose longest axis points at the camera (docs/numerics.md).

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  if (In.Options.Through != Spread::Jacobian || In.Options.Rolling)
    return {false, "not with the unscented transform or rolling shutters",
            false};
  if (In.Options.Kind != RendererKind::Splat)
    return {false, "not with rays", false};
  const std::size_t Count = In.Facts.Pointing;
  return {Count != 0,
          fmt::format("{} of {} Gaussians are needles that point at the camera",
                      Count, In.Gaussians.size()),
          Count != 0};
}

} // namespace

const Effect effects::Needles{.Name = "needles",
                              .Kind = EffectKind::Scene,
                              .What = "components of the axes across the ray, "
                                      "as unevaluated sums of two floats",
                              .Macro = "USE_NEEDLES",
                              .Detect = detect,
                              .Neutral = false,
                              .ByCamera = true};

} // namespace vorion::splat
