/// When compiling for a scene costs its first frame more than it saves.
#pragma once

#include "device/Launcher.h"
#include "render/Plan.h"

#include <cstddef>

namespace vorion::splat {

/// Whether a frame of \p Gaussians should be drawn by the programs with
/// run-time flags: only if these are compiled already (\p FlagsBuilt), \p
/// Unbuilt of the specialised ones are not, and to compile them takes longer
/// than flags cost this one frame. Where neither is compiled, the specialised
/// ones are less code.
bool paysToFallBack(std::size_t Gaussians, std::size_t Unbuilt,
                    bool FlagsBuilt);

/// \p Specialised, or the plan with run-time flags if \p L's device should
/// rather draw by it. Both give the same bits, not the same instructions: for
/// frames of which no figures are wanted.
RenderPlan cheaperFirstFrame(const Launcher &L, const RenderPlan &Specialised,
                             const EffectInputs &In);

} // namespace vorion::splat
