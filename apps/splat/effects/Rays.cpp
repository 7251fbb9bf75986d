// Gaussians along the rays of pixels in place of footprints (docs/cameras.md).

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

Finding detect(const EffectInputs &In) {
  const RendererKind Kind = In.Options.Kind;
  const bool Is = hasRayRecords(Kind);
  return {Is, fmt::format("--renderer {}", name(Kind)), Is};
}

Finding detectSurfels(const EffectInputs &In) {
  const RendererKind Kind = In.Options.Kind;
  const bool Is = Kind == RendererKind::Surfel;
  return {Is, fmt::format("--renderer {}", name(Kind)), Is};
}

} // namespace

const Effect effects::Rays{
    .Name = "rays",
    .Kind = EffectKind::Scene,
    .What = "records of rays, and a quotient for each pixel and Gaussian",
    .Macro = "USE_RAYS",
    .Detect = detect,
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
