//===- DivergentBarriers.h - barriers that lanes may miss -------*- C++ -*-===//
//
// A barrier waits for all lanes; if whether it is reached depends on which
// work-item asks, the program is wrong. Compiled into our tools, which see
// vx_bar, and into PoCL, which sees OpenCL C's barrier before it is split into
// regions: so it uses nothing but LLVM.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_DIVERGENTBARRIERS_H
#define VORION_LLVM_BACKEND_DIVERGENTBARRIERS_H

#include "llvm/ADT/StringRef.h"
#include <string>
#include <vector>

namespace llvm {
class CallBase;
class Function;
class Module;

namespace vorion {

struct DivergentBarrier {
  /// The barrier, or the call of a function that has one.
  const CallBase *Call;
  /// What to say of it.
  std::string Warning;
};

/// The barriers of \p F that are reached or not by a condition that is computed
/// from the work-item's id. Variables are seen through where they are values
/// (after mem2reg), not in memory. \p MayReturn: whether a work-item that has
/// returned takes part in all further barriers, as in kernels of OpenCL C.
std::vector<DivergentBarrier> findDivergentBarriers(Function &F,
                                                    bool MayReturn);

/// The same for all of \p M, which has not been optimised: a line
/// "file:line:column: KIND: text" for each, as compilers' logs have them; \p
/// Kind is "warning" or "error".
std::string divergentBarrierLog(const Module &M, StringRef Kind);

} // namespace vorion
} // namespace llvm

#endif
