// Places that fp32 cannot measure from the axis: in a window beside the
// principal point, and through a long lens (docs/cameras.md).

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

/// In the camera's axes fp32 has a step of 2^-24 of a point's distance, and the
/// focal length makes it this many pixels: beyond it, 2^-11 and more.
constexpr double Longest = 8192;

Finding detect(const EffectInputs &In) {
  if (In.Options.Optics->CoversSphere ||
      In.Options.Through != Spread::Jacobian || In.Options.Rolling)
    return {
        false,
        "not with full spheres, the unscented transform or rolling shutters",
        false};
  if (In.Options.Kind != RendererKind::Splat)
    return {true, "rays have no dilation to hide an error of a place behind"};
  const ViewFacts &F = In.Facts;
  const bool IsParallel = In.Options.Optics->IsParallel;
  const double Length = IsParallel ? F.FocalLength * F.Farthest : F.FocalLength;
  const bool IsLong = Length > Longest;
  return {F.IsCrop || IsLong,
          F.IsCrop ? "the principal point is outside the picture"
                   : fmt::format("the principal point is in the picture; {} of "
                                 "{:.6g} pixels, more than {} need it",
                                 IsParallel ? "a distance" : "a focal length",
                                 Length, Longest),
          F.IsCrop || IsLong};
}

} // namespace

const Effect effects::Crop{
    .Name = "crop",
    .Kind = EffectKind::Scene,
    .What = "means relative to the ray through the picture's centre, as "
            "unevaluated sums of two floats",
    .Macro = "USE_CROP",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
