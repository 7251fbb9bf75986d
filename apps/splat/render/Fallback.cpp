#include "render/Fallback.h"

#include <algorithm>
#include <utility>

namespace vorion::splat {

namespace {

/// Of one program, from OpenCL C to an image (bench/effects.py --first-frame).
constexpr double BuildSeconds = 0.24;
/// What testing flags costs: 52 instructions for 16 Gaussians, at 1.5e8 a
/// second.
constexpr double FlagSecondsPerGaussian = 52.0 / 16 / 1.5e8;

} // namespace

bool paysToFallBack(std::size_t Gaussians, std::size_t Unbuilt,
                    bool FlagsBuilt) {
  return FlagsBuilt && Unbuilt != 0 &&
         static_cast<double>(Gaussians) * FlagSecondsPerGaussian <
             static_cast<double>(Unbuilt) * BuildSeconds;
}

RenderPlan cheaperFirstFrame(const Launcher &L, const RenderPlan &Specialised,
                             const EffectInputs &In) {
  const auto Unbuilt = [&L](const RenderPlan &P) {
    return static_cast<std::size_t>(std::ranges::count_if(
        P.Programs, [&](const ProgramSpec &S) { return !L.wasBuilt(S); }));
  };
  EffectRequest Flags;
  Flags.Selection = EffectRequest::Mode::Flags;
  RenderPlan Flagged = planRender(EffectPlan(Flags, In), In.Options);
  return paysToFallBack(In.Gaussians.size(), Unbuilt(Specialised),
                        Unbuilt(Flagged) == 0)
             ? Flagged
             : Specialised;
}

} // namespace vorion::splat
