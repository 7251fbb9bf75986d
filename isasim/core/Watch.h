/// Between an observed core and its observers: works out what an instruction
/// accesses, once for all of them.
#pragma once

#include "core/CodeTable.h"
#include "core/Isa.h"
#include "vorion/isasim/Observer.h"

#include <vector>

namespace vorion::isasim {

/// The access that \p D makes, without its addresses; false for none.
bool describeAccess(const Decoded &D, MemoryAccess &A);

/// Threads: all cores that share it run on one.
class Watch {
public:
  /// For \p Warps warps of all cores together that run \p Code.
  void prepare(const CodeTable &Code, unsigned WarpsPerCore, unsigned Cores);

  std::vector<Observer *> Observers;

  void fetch(WarpState *S, const Insn *I, uint64_t Retired);
  void commit(WarpState *S, const Insn *I);

  /// Calls F on every observer.
  template <typename Function> void tell(Function F) const {
    for (Observer *O : Observers)
      F(*O);
  }

private:
  /// What was seen when a warp's present instruction was fetched.
  struct Pending {
    MemoryAccess Access;
    bool HasAccess = false;
    uint32_t LaneMask = 0;
    uint64_t Retired = 0;
    uint64_t DivergentSplits = 0;
  };

  Pending &pendingOf(const WarpState *S);

  std::vector<Decoded> Insns; ///< by index of the code table
  std::vector<Pending> Warps;
  unsigned WarpsPerCore = 1;
};

} // namespace vorion::isasim
