/// XVortex, Zicond and the atomics as the records say (intrinsics/Simt.td;
/// RISC-V unprivileged specification, Zaamo, Zacas and Zicond), one lane after
/// another. Shares nothing with core/insns.
#pragma once

#include "core/IsaTables.h"
#include "core/State.h"
#include "vorion/isasim/TrapCause.h"

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace vorion::isasim::testing {

/// A warp as the specification has it, and how it stopped.
struct SimtModel {
  static constexpr unsigned NumBarriers = 16;
  static constexpr unsigned StackLimit = 4;
  /// Words that atomics work on, few so that lanes meet: half in local memory.
  static constexpr unsigned Words = 12;

  struct StackEntry {
    uint32_t Mask, Other;
    unsigned Pc;
    bool operator==(const StackEntry &) const = default;
  };

  uint32_t X[32][MaxLanes] = {};
  uint32_t Mask = 0;
  uint32_t Whole = 0; ///< as vx_tmc has set the mask
  unsigned Pc = 0;    ///< in instructions
  std::vector<StackEntry> Stack;
  std::array<uint32_t, Words> Memory{};
  Stop Why = Stop::Ready;
  std::optional<TrapCause> Trap;
  unsigned TrapLane = 0;

  bool active(unsigned L) const { return Mask >> L & 1; }
  unsigned first() const {
    unsigned L = 0;
    while (!active(L))
      ++L;
    return L;
  }
  unsigned last() const {
    unsigned L = MaxLanes - 1;
    while (!active(L))
      --L;
    return L;
  }
  void trap(TrapCause Cause, unsigned Lane) {
    Why = Stop::Trapped;
    Trap = Cause;
    TrapLane = Lane;
  }

  static bool isLocal(unsigned Word) { return Word < Words / 2; }
  static uint32_t wordAddress(unsigned Word) {
    return isLocal(Word) ? VX_LOCAL_BASE + 4 * Word
                         : VX_GLOBAL_BASE + 4 * (Word - Words / 2);
  }
  /// The number of the word at an address, Words if there is none.
  static unsigned wordAt(uint32_t Address) {
    unsigned N = 0;
    while (N != Words && wordAddress(N) != Address)
      ++N;
    return N;
  }
};

/// Numbers of registers.
struct Operands {
  unsigned Rd, Rs1, Rs2;
};

/// What an instruction does to a warp, but for the step to the next one.
using Step = std::function<void(SimtModel &, Operands)>;

/// Of every instruction of XVortex, Zicond, Zaamo and Zacas.
const std::map<Op, Step> &simtSteps();

} // namespace vorion::isasim::testing
