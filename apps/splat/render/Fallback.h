/// Selection of precompiled programs if compiling for a scene takes longer than
/// it saves in the first frame.
#pragma once

#include "device/Launcher.h"
#include "render/Plan.h"

#include <cstddef>

namespace vorion::splat {

/// Whether a frame of \p Gaussians should use the programs with run-time flags:
/// only if these are compiled (\p FlagsBuilt), \p Unbuilt of the specialized
/// programs are not, and compiling them takes longer than the flags cost in
/// this frame. If neither are compiled, the specialized programs have less
/// code.
bool paysToFallBack(std::size_t Gaussians, std::size_t Unbuilt,
                    bool FlagsBuilt);

/// \p Specialised, or the plan with run-time flags if that is faster on \p L's
/// device. Pictures are bit-identical, instruction counts are not: only for
/// frames without reports.
RenderPlan cheaperFirstFrame(const Launcher &L, const RenderPlan &Specialised,
                             const EffectInputs &In);

} // namespace vorion::splat
