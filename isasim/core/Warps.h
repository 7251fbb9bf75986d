/// What instructions do to warps as a whole: traps, masks, other warps and
/// barriers. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

/// Stops \p S with \p Cause (a TrapCause) at the instruction that is executing.
void raise(WarpState *S, uint32_t Cause, uint32_t Lane, uint32_t Address);

/// Sets the active lanes and everything that depends on them.
void setMask(WarpState *S, uint32_t Mask);

/// vx_wspawn and vx_bar, see Simt.td. False if the warp traps or waits.
bool spawnWarps(WarpState *S, uint32_t Warps, uint32_t Entry);
bool barrier(WarpState *S, uint32_t Id, uint32_t Count);

} // namespace vorion::isasim
