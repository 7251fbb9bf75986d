//===- SimtBarriers.h - barriers among work-items on lanes ----------------===//

#ifndef POCL_SIMT_BARRIERS_H
#define POCL_SIMT_BARRIERS_H

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/Function.h>
#include <llvm/IR/Instruction.h>

#include <set>

namespace pocl {

/// Removes PoCL's barriers, where there are no loops in favour of the
/// machine's.
bool lowerSimtBarriers(llvm::Function &F);

/// Puts a barrier at the head of each loop that has one anywhere. Otherwise an
/// inner loop at its head may come to share its header, and lanes that have
/// left the inner loop would pass the barrier while others are in it. Where a
/// round may pass no barrier and single work-items may leave, the head gets
/// only what keeps it apart: work-items may go on without the others there.
void anchorBarrierLoops(llvm::Function &F, llvm::LoopInfo &Loops,
                        llvm::PostDominatorTree &PostDominators);

/// Tells branches of single work-items from those of the whole group. Knows
/// them by their terminators, which stay when blocks are split; empty on
/// devices without lanes.
class SimtBranches {
public:
  SimtBranches(llvm::Function &F, llvm::LoopInfo &Loops,
               llvm::PostDominatorTree &PostDominators);

  /// Whether this end of a barrier's block belongs into the region after the
  /// barrier: work-items may part there, or their ways may meet again before
  /// the next barrier.
  bool isOfRegion(const llvm::Instruction *Terminator) const {
    return OfRegion.count(Terminator);
  }
  /// Whether this branch decides for the whole group: a loop with a barrier is
  /// left here or gone round again, or the ways come to different barriers. At
  /// the end of a barrier's block it stays with its barrier.
  bool decides(const llvm::Instruction *Terminator) const {
    return Deciding.count(Terminator);
  }

private:
  std::set<const llvm::Instruction *> OfRegion, Deciding;
};

} // namespace pocl

#endif
