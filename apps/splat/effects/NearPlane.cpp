// Gaussians behind the rules' least depth are not drawn.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const float Limit = In.Options.nearLimit();
  const ViewFacts &F = In.Facts;
  if (In.Options.Rolling)
    return {false,
            "the code of the shutter tests each mean at its own exposure time"};
  return {!(F.NearestDepth - F.DepthSlack > Limit),
          fmt::format("nearest mean at depth {:.6g}, limit {:g}",
                      F.NearestDepth, Limit)};
}

} // namespace

const Effect effects::NearPlane{.Name = "near-plane",
                                .Kind = EffectKind::Scene,
                                .What = "the test of each depth",
                                .Macro = "USE_NEAR_PLANE",
                                .Detect = detect};

} // namespace vorion::splat
