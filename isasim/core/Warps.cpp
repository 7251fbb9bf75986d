#include "core/Warps.h"

#include "core/Core.h"

#include <bit>

namespace vorion::isasim {

void raise(WarpState *S, uint32_t Cause, uint32_t Lane, uint32_t Address) {
  S->Why = Stop::Trapped;
  S->FaultCause = Cause;
  S->FaultLane = Lane;
  S->FaultAddress = Address;
}

void setMask(WarpState *S, uint32_t Mask) {
  S->Mask = S->WholeMask = Mask;
  S->Full = Mask == (1U << MaxLanes) - 1;
  S->LaneCount = static_cast<uint32_t>(std::popcount(Mask));
  S->LastLane = static_cast<uint32_t>(std::bit_width(Mask)) - 1;
  for (unsigned L = 0; L != MaxLanes; ++L)
    S->MaskWords[L] = 0U - (Mask >> L & 1);
}

bool spawnWarps(WarpState *S, uint32_t Warps, uint32_t Entry) {
  return S->Owner->spawn(*S, Warps, Entry);
}

bool barrier(WarpState *S, uint32_t Id, uint32_t Count) {
  return S->Owner->arrive(*S, Id, Count);
}

} // namespace vorion::isasim
