/// What instructions that go lane by lane have in common. Not for vector
/// levels: they would share these functions.
#pragma once

#include "core/Warps.h"
#include "vorion/isasim/TrapCause.h"

#include <bit>
#include <cstdint>

namespace vorion::isasim {

/// Calls F(lane) for every active lane, ascending, until one returns false.
template <typename Function> bool forLanes(const WarpState *S, Function F) {
  for (uint32_t Left = S->Mask; Left; Left &= Left - 1)
    if (!F(static_cast<unsigned>(std::countr_zero(Left))))
      return false;
  return true;
}

/// The warp traps at lane \p Lane; false, for the instruction to return.
inline bool fault(WarpState *S, TrapCause Cause, unsigned Lane, uint32_t Addr) {
  raise(S, static_cast<uint32_t>(Cause), Lane, Addr);
  return false;
}

/// Copies the lanes of the mask from Values to register offset Rd.
inline void writeLanes(WarpState *S, unsigned Rd, const uint32_t *Values) {
  uint32_t *To = S->lanes(Rd);
  forLanes(S, [&](unsigned L) {
    To[L] = Values[L];
    return true;
  });
}

} // namespace vorion::isasim
