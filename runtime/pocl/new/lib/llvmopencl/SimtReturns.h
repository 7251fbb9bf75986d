//===- SimtReturns.h - work-items that return before a barrier ------------===//

#ifndef POCL_SIMT_RETURNS_H
#define POCL_SIMT_RETURNS_H

#include "SimtBlocks.h"

#include <llvm/ADT/SmallPtrSet.h>

namespace pocl {

/// Where work-items may differ. They are taken to agree in what they compute
/// from arguments, group ids and memory that all of them read at one address,
/// and in nothing else.
struct Differences {
  BlockSet Branches; ///< the blocks at whose end they may part
  llvm::SmallPtrSet<const llvm::Value *, 32> Values;
};
Differences differencesIn(llvm::Function &F);

/// Where a work-item may return, or pass the last barrier's place, while others
/// of its group go on to a barrier; null if nowhere:
///
///     if (get_global_id(0) >= n) return;
///     barrier();
llvm::BasicBlock *returnBeforeBarrier(llvm::Function &F);

} // namespace pocl

#endif
