/// Which cache lines an access asks for: the rule of the load/store unit, for
/// the clock and for the profile without it.
#pragma once

#include "core/State.h"

#include <cstdint>

namespace vorion::isasim {

/// The bits of \p Words that are set in any active lane of \p S.
inline uint32_t bitsOfAny(const WarpState &S, const LaneWords &Words) {
  const LaneWords Active = Words & S.MaskWords;
  uint32_t Any = 0;
  for (unsigned L = 0; L != MaxLanes; ++L)
    Any |= Active[L];
  return Any;
}

/// Writes the distinct lines of memory that the active lanes of \p S name to
/// \p Lines, which has room for one a lane, and returns how many. \p Addresses
/// are by lane. \p InterleavedStacks is timing.core.interleaved_stacks. Local
/// memory has no lines: the caller asks before.
unsigned linesOfAccess(const WarpState &S, const uint32_t *Addresses,
                       bool InterleavedStacks, uint32_t *Lines);

} // namespace vorion::isasim
