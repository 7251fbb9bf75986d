// Gaussians along the rays of pixels in place of footprints (docs/cameras.md).

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding byRenderer(const EffectInputs &In, bool Is) {
  return {Is, fmt::format("--renderer {}", name(In.Options.Kind)), Is};
}

Finding detectRays(const EffectInputs &In) {
  return byRenderer(In, hasRayRecords(In.Options.Kind));
}

Finding detectSurfels(const EffectInputs &In) {
  return byRenderer(In, In.Options.Kind == RendererKind::Surfel);
}

Finding detectDegree4(const EffectInputs &In) {
  const unsigned Degree = In.Options.FalloffDegree;
  return {Degree == 4, fmt::format("--falloff-degree {}", Degree), Degree == 4};
}

} // namespace

const Effect effects::Rays{
    .Name = "rays",
    .Kind = EffectKind::Scene,
    .What = "records of rays, and a quotient for each pixel and Gaussian",
    .Macro = "USE_RAYS",
    .Detect = detectRays,
    .Neutral = false,
    .ByCamera = true};

const Effect effects::Degree4{.Name = "degree-4",
                              .Kind = EffectKind::Scene,
                              .What = "densities of exp(-q^2 / 18) along rays",
                              .Macro = "USE_DEGREE4",
                              .Detect = detectDegree4,
                              .Neutral = false,
                              .ByCamera = true};

const Effect effects::Surfels{
    .Name = "surfels",
    .Kind = EffectKind::Scene,
    .What = "a low pass on the picture for Gaussians that rays meet",
    .Macro = "USE_SURFELS",
    .Detect = detectSurfels,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
