//===- SimtReturns.h - work-items that return before a barrier ------------===//

#ifndef POCL_SIMT_RETURNS_H
#define POCL_SIMT_RETURNS_H

#include "SimtBlocks.h"

namespace pocl {

/// The blocks at whose end work-items may part. They are taken to agree in what
/// they compute from arguments, group ids and memory that all of them read at
/// one address, and in nothing else.
BlockSet branchesOfSome(llvm::Function &F);

/// Whether a work-item may return, or pass the last barrier's place, while
/// others of its group go on to a barrier:
///
///     if (get_global_id(0) >= n) return;
///     barrier();
bool returnsBeforeBarrier(llvm::Function &F);

} // namespace pocl

#endif
