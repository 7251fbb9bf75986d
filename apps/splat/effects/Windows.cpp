// A wide picture, whose windows have their own records (docs/cameras.md).

#include "effects/Registry.h"

#include <fmt/format.h>

namespace vorion::splat {

namespace {

/// Beyond this fp32 has a step of 2^-11 px and more for a place.
constexpr unsigned Widest = 4096;

Finding detect(const EffectInputs &In) {
  if (In.Options.Through != Spread::Jacobian || In.Options.Rolling)
    return {false, "not with the unscented transform or rolling shutters",
            false};
  if (In.Options.Kind != RendererKind::Splat)
    return {false, "the records of rays have places from their boxes", false};
  const bool IsWide = In.Facts.Side > Widest;
  return {IsWide,
          fmt::format("a side of {} pixels; more than {} need windows",
                      In.Facts.Side, Widest),
          IsWide};
}

} // namespace

const Effect effects::Windows{
    .Name = "windows",
    .Kind = EffectKind::Scene,
    .What =
        "records per window of the picture, with means relative to the window",
    .Macro = "USE_WINDOWS",
    .Detect = detect,
    .Neutral = false,
    .ByCamera = true};

} // namespace vorion::splat
