/// Atomics, lane by lane. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

enum class Amo : uint8_t {
  Add,
  Swap,
  Xor,
  And,
  Or,
  Min,
  Max,
  Minu,
  Maxu,
  Cas,
  CasPair ///< of 64 bits, in pairs of registers
};

/// The bytes of a lane that an atomic accesses. Vector levels ask at compile
/// time only: they would share this function.
constexpr unsigned bytesOf(Amo Kind) { return Kind == Amo::CasPair ? 8 : 4; }

// False if the warp stops (WarpState::Why says why): the instruction has not
// been executed.

/// Executes an atomic if it need not wait for the other cores: all of its
/// addresses are in local memory, or it is an addition without a result.
bool amoOrPark(WarpState *S, const Insn *I, Amo Kind);
/// Executes an atomic lane by lane; all cores are parked.
bool amoNow(WarpState *S, const Insn *I, Amo Kind);
/// The kind of the atomic \p I.
Amo amoKind(const Insn *I);

} // namespace vorion::isasim
