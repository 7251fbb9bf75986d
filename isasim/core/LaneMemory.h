/// Loads and stores lane by lane: what is not one contiguous, mapped range,
/// with faults and the words for console and exit. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

// False if the warp stops (WarpState::Why says why): the instruction has not
// been executed.

/// A load of \p Bytes (1, 2, 4), lane by lane, into I->Rd.
bool loadByLane(WarpState *S, const Insn *I, unsigned Bytes, bool Signed);
/// A store in lane order; also the console and exit words.
bool storeByLane(WarpState *S, const Insn *I, unsigned Bytes);

} // namespace vorion::isasim
