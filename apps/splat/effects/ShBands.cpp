// The bands of spherical harmonics above the constant one.

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

/// Beyond this, a direction's length may overflow, and a band of zeros then
/// makes a NaN (0 times infinity) of a colour.
constexpr double LargestReach = 1e18;

template <int Band> Finding detect(const EffectInputs &In) {
  if (Band > In.Options.ShLimit)
    return {false, fmt::format("--sh-degree {}", In.Options.ShLimit), false};
  const std::size_t Witness = In.Facts.BandWitness[Band - 1];
  if (Witness != ViewFacts::NoWitness)
    return {true, fmt::format("Gaussian {} has a coefficient that is not 0",
                              Witness)};
  if (!(In.Facts.Reach <= LargestReach))
    return {true, fmt::format("coordinates up to {:g}, limit {:g}",
                              In.Facts.Reach, LargestReach)};
  if (Band > In.Gaussians.ShDegree)
    return {false,
            fmt::format("the scene has degree {}", In.Gaussians.ShDegree)};
  return {false, fmt::format("all {} coefficients are 0",
                             In.Gaussians.size() * 3 * (2 * Band + 1))};
}

} // namespace

namespace effects {

const Effect Sh1{.Name = "sh1",
                 .Kind = EffectKind::Scene,
                 .What = "SH degree 1: 9 planes, 3 terms per channel",
                 .Macro = "USE_SH1",
                 .Detect = detect<1>,
                 .Within = &ViewColor};

const Effect Sh2{.Name = "sh2",
                 .Kind = EffectKind::Scene,
                 .What = "SH degree 2: 15 planes, 5 terms per channel",
                 .Macro = "USE_SH2",
                 .Detect = detect<2>,
                 .Within = &ViewColor};

const Effect Sh3{.Name = "sh3",
                 .Kind = EffectKind::Scene,
                 .What = "SH degree 3: 21 planes, 7 terms per channel",
                 .Macro = "USE_SH3",
                 .Detect = detect<3>,
                 .Within = &ViewColor};

} // namespace effects
} // namespace vorion::splat
