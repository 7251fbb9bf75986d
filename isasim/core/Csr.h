/// CSR instructions. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

/// The fields of a CSR instruction.
struct CsrAccess {
  enum Combine : uint8_t { Swap = 1, SetBits = 2, ClearBits = 3 };
  uint16_t Number;
  uint8_t Source; ///< x register or immediate
  bool IsImmediate, Reads, Writes;
  Combine Kind;

  /// What lane \p Lane brings.
  uint32_t operand(WarpState *S, unsigned Lane) const;
  /// What is written.
  uint32_t combine(uint32_t Old, uint32_t Operand) const;
};
CsrAccess csrAccess(const Insn *I);

/// Executes a CSR instruction, or parks it if it is the rasterizer's. All
/// instructions before it must have been counted. False if the warp stops
/// (WarpState::Why says why): the instruction has not been executed.
bool csrOrPark(WarpState *S, const Insn *I);

} // namespace vorion::isasim
