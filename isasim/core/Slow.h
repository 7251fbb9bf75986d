/// What instructions call when the fast path does not do: lanes one by one,
/// faults, CSRs. Compiled once, for any host.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

/// Stops \p S with \p Cause (a TrapCause) at the instruction that is executing.
void raise(WarpState *S, std::uint32_t Cause, std::uint32_t Lane,
           std::uint32_t Address);

// The following return false when the warp stops (WarpState::Why says why) and
// the instruction has not been executed.

/// A load of \p Bytes (1, 2, 4), lane by lane, into I->Rd.
bool slowLoad(WarpState *S, const Insn *I, unsigned Bytes, bool Signed);
/// A store in lane order; also the console and exit words.
bool slowStore(WarpState *S, const Insn *I, unsigned Bytes);

enum class Amo : std::uint8_t {
  Add,
  Swap,
  Xor,
  And,
  Or,
  Min,
  Max,
  Minu,
  Maxu,
  Cas
};

/// Executes an atomic if it need not wait for the other cores: all of its
/// addresses are in local memory, or it is an addition without a result.
bool amoOrPark(WarpState *S, const Insn *I, Amo Kind);
/// Executes an atomic lane by lane; all cores are parked.
bool amoNow(WarpState *S, const Insn *I, Amo Kind);
/// The kind of the atomic \p I.
Amo amoKind(const Insn *I);

/// The fields of a CSR instruction.
struct CsrAccess {
  enum Combine : std::uint8_t { Swap = 1, SetBits = 2, ClearBits = 3 };
  std::uint16_t Number;
  std::uint8_t Source; ///< x register or immediate
  bool IsImmediate, Reads, Writes;
  Combine Kind;

  /// What lane \p Lane brings.
  std::uint32_t operand(WarpState *S, unsigned Lane) const;
  /// What is written.
  std::uint32_t combine(std::uint32_t Old, std::uint32_t Operand) const;
};
CsrAccess csrAccess(const Insn *I);

/// Executes a CSR instruction, or parks it if it is the rasterizer's. All
/// instructions before it must have been counted.
bool csrOrPark(WarpState *S, const Insn *I);

// Rounded operations in a mode that the host's unit is not in, lane by lane.
enum class FpOp : std::uint8_t {
  Add,
  Sub,
  Mul,
  Div,
  Sqrt,
  Madd,
  Msub,
  Nmsub,
  Nmadd,
  ToInt,
  ToUint,
  FromInt,
  FromUint
};
bool softFp(WarpState *S, const Insn *I, FpOp O);

/// vx_wspawn and vx_bar, see Simt.td. False if the warp traps or waits.
bool spawnWarps(WarpState *S, std::uint32_t Warps, std::uint32_t Entry);
bool barrier(WarpState *S, std::uint32_t Id, std::uint32_t Count);

/// Sets the active lanes and everything that depends on them.
void setMask(WarpState *S, std::uint32_t Mask);

/// Sets frm (0 to 7) and puts the host's unit into it.
void setFrm(WarpState *S, std::uint32_t Frm);

/// Tells the observers that \p I is about to be executed (the instructions from
/// \p Start on have not been counted yet), and that it has been.
void observeFetch(WarpState *S, const Insn *I, const Insn *Start);
void observeCommit(WarpState *S, const Insn *I);

} // namespace vorion::isasim
