//===- SimtBlocks.h - blocks that a whole group runs together -------------===//

#ifndef POCL_SIMT_BLOCKS_H
#define POCL_SIMT_BLOCKS_H

#include <llvm/ADT/ArrayRef.h>
#include <llvm/ADT/STLFunctionalExtras.h>
#include <llvm/ADT/SmallPtrSet.h>

#include <vector>

namespace llvm {
class BasicBlock;
class Function;
class Loop;
class LoopInfo;
class PostDominatorTree;
class Value;
} // namespace llvm

namespace pocl {

using BlockSet = llvm::SmallPtrSet<llvm::BasicBlock *, 16>;

/// The barriers that a work-item may come to first behind \p From, if it does
/// not pass \p Without, which may be null. A return counts as one.
BlockSet nextBarriers(llvm::BasicBlock *From,
                      const llvm::BasicBlock *Without = nullptr);

/// Those that two ways from \p Block may come to next. What lies behind
/// \p Without, where the ways meet, does not count.
BlockSet reachedTwice(llvm::BasicBlock &Block,
                      const llvm::BasicBlock *Without = nullptr);

/// Keeps what is computed in one of the blocks and used in others in a variable
/// on the stack, because it will no longer be computed there alone.
void keepInVariables(llvm::ArrayRef<llvm::BasicBlock *> Blocks);

/// Whether a block of the loop is reached from its head without a barrier.
bool isReachedWithoutBarrier(llvm::BasicBlock *Block, const llvm::Loop &L);

/// What decides where \p Block goes on; null if nothing does.
llvm::Value *decidingValue(llvm::BasicBlock &Block);

/// Without irreducible loops, a block that dominates another in the same
/// innermost loop and that the other post-dominates runs as often as that one.
bool hasIrreducibleLoops(const llvm::Function &F, const llvm::LoopInfo &Loops);

/// Which blocks of a kernel single work-items may pass, or pass more often than
/// others: those that depend on a branch at which work-items part. Whether a
/// branch is such a one depends on variables, and what these keep on the blocks
/// that write them. So the search begins with no such block and goes on until
/// it finds no more.
class SimtBlocks {
public:
  SimtBlocks(llvm::Function &F, llvm::LoopInfo &Loops,
             llvm::PostDominatorTree &PostDominators);

  bool mayBeOfSome(llvm::BasicBlock *Block) const {
    return OfSome.count(Block);
  }

  /// Finds blocks that mayBeOfSome(); false if there are no more. \p Agree: if
  /// the whole group has the same value, as far as is known of the blocks.
  bool findMore(llvm::function_ref<bool(llvm::Value *)> Agree);

private:
  /// Blocks that run or not, or once more or not, as a branch decides.
  struct Dependence {
    llvm::BasicBlock *Branch;
    llvm::Value *Condition;
    BlockSet Blocks;
  };
  std::vector<Dependence> Dependences;
  BlockSet OfWholeGroup, OfSome;
};

} // namespace pocl

#endif
