//===- SimtWays.h - the ways of a kernel that lead to a return ------------===//

#ifndef POCL_SIMT_WAYS_H
#define POCL_SIMT_WAYS_H

#include "SimtBlocks.h"

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/BitVector.h>
#include <llvm/ADT/DenseMap.h>
#include <llvm/ADT/SmallVector.h>
#include <llvm/ADT/StringRef.h>

#include <set>
#include <utility>
#include <vector>

namespace pocl {

/// The name of the function that \p V calls; empty if it calls none by name.
llvm::StringRef nameOfCalled(const llvm::Value *V);

using Edge = std::pair<llvm::BasicBlock *, llvm::BasicBlock *>;

/// The ways of a kernel that lead to a return. A dead end, such as an endless
/// loop, has none, or one that is never taken (SimtExits.h).
class WaysToReturn {
public:
  /// \p Without: edges that count as not there.
  explicit WaysToReturn(llvm::Function &F, const std::set<Edge> &Without = {});

  llvm::ArrayRef<llvm::BasicBlock *>
  behind(const llvm::BasicBlock *Block) const {
    return Live[number(Block)];
  }

  /// Whether a barrier lies in \p Block or behind it.
  bool mayReachBarrier(llvm::BasicBlock *Block) const {
    return BeforeBarrier.contains(Block);
  }

  /// Whether all ways from \p Block come to \p Other, which may be the same.
  bool leadTo(const llvm::BasicBlock *Block,
              const llvm::BasicBlock *Other) const {
    return After[number(Block)].test(number(Other));
  }

  /// The blocks that all ways from \p Block come to, the nearest first, without
  /// itself.
  llvm::SmallVector<llvm::BasicBlock *, 8>
  allBehind(const llvm::BasicBlock *Block) const;

  /// The first of these; null if there is none.
  llvm::BasicBlock *meetingOf(const llvm::BasicBlock *Block) const;

private:
  void findLiveEdges(llvm::Function &F, const std::set<Edge> &Without);
  void findPostDominators();
  /// The blocks of which \p IsGoal holds, and those that lead there.
  BlockSet allBefore(llvm::function_ref<bool(llvm::BasicBlock *)> IsGoal) const;
  unsigned number(const llvm::BasicBlock *Block) const {
    return NumberOf.lookup(Block);
  }

  std::vector<llvm::BasicBlock *> Blocks;
  llvm::DenseMap<const llvm::BasicBlock *, unsigned> NumberOf;
  std::vector<llvm::SmallVector<llvm::BasicBlock *, 4>> Live;
  /// The blocks that post-dominate each, itself included.
  std::vector<llvm::BitVector> After;
  BlockSet BeforeBarrier;
};

} // namespace pocl

#endif
