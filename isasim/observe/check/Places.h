/// What a guest address is, in words and as a region, for the checkers.
#pragma once

#include "core/IsaTables.h"
#include "observe/check/Buffers.h"
#include "vorion/isasim/Observer.h"

#include <algorithm>
#include <string>

namespace vorion::isasim {

/// What all checkers share: the machine's shape, the run's program and who
/// holds global memory.
class Places {
public:
  enum Kind { Global, Local, Stack, Program, Nothing };

  Buffers Held;
  /// Local memory that the next run's groups have.
  uint64_t LocalUsed = UINT32_MAX;

  void begin(const RunStart &R);

  Kind kindOf(uint32_t Address) const;
  /// Whether the work-item may access [Address, Address + Bytes).
  bool isOwn(uint32_t Address, unsigned Bytes, const Step &S,
             unsigned Lane) const;
  /// In words.
  std::string describe(uint32_t Address, const Step &S, unsigned Lane) const;
  /// "store of 4 bytes at 0x..., 0 bytes past the end of ...", of a step that
  /// accesses memory.
  std::string describeAccess(const Step &S, unsigned Lane) const;

  /// Whether \p S, which accesses memory, is an atomic, or a load or store that
  /// the program's compiler knows to be one.
  bool isAtomic(const Step &S) const {
    return S.Access->What == MemoryAccess::Atomic ||
           (Code && Code->isAtomicPlace(S.Pc));
  }

  /// Who has local memory, and groups, one after the other: a warp where a
  /// launch gives groups to warps, else a core. Numbers below agents().
  unsigned agentOf(const Step &S) const {
    return S.Core * Shape.WarpsPerCore + (HasLaunch ? S.Warp : 0);
  }
  unsigned agents() const { return Shape.cores() * Shape.WarpsPerCore; }
  /// Whether \p Address is in what the driver keeps for groups.
  bool isContext(uint32_t Address) const {
    return Address - Launch.Context <
           Launch.ContextStride * Shape.cores() * Launch.Warps;
  }

  /// That of the machine, with the stacks of the run.
  const Config &shape() const { return Shape; }
  /// Of the run, all 0 if it has none.
  const VxLaunch &launch() const { return Launch; }
  bool hasLaunch() const { return HasLaunch; }

private:
  /// Of a core, that have stacks.
  unsigned warps() const {
    return HasLaunch ? std::max(Launch.Warps, 1U) : Shape.WarpsPerCore;
  }
  /// Where a second warp of a program has its stacks is the program's affair.
  bool hasOwnStacks() const { return Shape.WarpsPerCore == 1 || HasLaunch; }
  /// The number of the lane's own stack.
  uint32_t stackOf(const Step &S, unsigned Lane) const {
    return (S.Core * warps() + S.Warp) * Shape.LanesPerWarp + Lane;
  }
  /// The number of the stack that holds \p Address.
  uint32_t stackOf(uint32_t Address) const {
    return (VX_STACK_TOP - 1 - Address) / Shape.StackBytes;
  }
  uint64_t localEnd() const {
    return VX_LOCAL_BASE + std::min<uint64_t>(LocalUsed, Shape.LocalBytes);
  }

  Config Shape;
  uint64_t Stacks = 0; ///< bytes of all of them
  std::shared_ptr<const Image> Code;
  VxLaunch Launch{};
  bool HasLaunch = false;
};

} // namespace vorion::isasim
