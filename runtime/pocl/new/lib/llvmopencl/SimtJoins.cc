#include "SimtJoins.h"

#include "Barrier.h"
#include "LLVMUtils.h"
#include "SimtBarriers.h"
#include "SimtBlocks.h"
#include "VariableUniformityAnalysis.h"
#include "Workgroup.h"
#include "WorkitemHandlerChooser.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/ADT/SetVector.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/CFG.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>

using namespace llvm;

namespace pocl {

namespace {

/// The ways into a block that belong to one region.
struct Way {
  BlockSet Region; ///< of which \c Last are the last blocks
  SmallVector<BasicBlock *, 4> Last;
};

/// Whether nothing of a region lies between the block's last barrier and its
/// end.
bool endsRegion(BasicBlock &Block, const SimtBranches &Branches) {
  return Barrier::endsWithBarrier(&Block) &&
         !Branches.isOfRegion(Block.getTerminator());
}

/// All blocks from which \p Last is reached without a barrier, itself included.
BlockSet regionBefore(BasicBlock *Last, const SimtBranches &Branches) {
  BlockSet Region{Last};
  SmallVector<BasicBlock *, 16> Pending{Last};
  while (!Pending.empty()) {
    BasicBlock *Block = Pending.pop_back_val();
    if (!Barrier::hasBarrier(Block))
      for (BasicBlock *Before : predecessors(Block))
        if (!endsRegion(*Before, Branches) && Region.insert(Before).second)
          Pending.push_back(Before);
  }
  return Region;
}

/// Those that do not end with a barrier yet.
std::vector<Way> waysInto(BasicBlock &Block, const SimtBranches &Branches) {
  std::vector<Way> Ways;
  const SetVector<BasicBlock *> Predecessors(pred_begin(&Block),
                                             pred_end(&Block));
  for (BasicBlock *Last : Predecessors) {
    if (endsRegion(*Last, Branches))
      continue;
    Way Joined{regionBefore(Last, Branches), {Last}};
    for (auto I = Ways.begin(); I != Ways.end();) {
      const bool Meet = any_of(
          I->Region, [&](BasicBlock *B) { return Joined.Region.count(B); });
      if (!Meet) {
        ++I;
        continue;
      }
      Joined.Region.insert(I->Region.begin(), I->Region.end());
      Joined.Last.append(I->Last);
      I = Ways.erase(I);
    }
    Ways.push_back(std::move(Joined));
  }
  return Ways;
}

/// The branches of a way's region at which work-items may part, so that some
/// come to \p Block and others go around it. One after which they come to
/// different barriers is none: there the whole group agrees.
SmallVector<BasicBlock *, 4> partings(const Way &W, BasicBlock &Block,
                                      const PostDominatorTree &PostDominators) {
  const BlockSet Behind = nextBarriers(&Block);
  const auto GoesAround = [&](BasicBlock *Next) {
    if (Next == &Block || W.Region.count(Next))
      return false;
    const BlockSet Around = nextBarriers(Next, &Block);
    return any_of(Around, [&](BasicBlock *B) { return Behind.count(B) != 0; });
  };
  SmallVector<BasicBlock *, 4> Found;
  for (BasicBlock *Branch : W.Region)
    if (!PostDominators.dominates(&Block, Branch) &&
        any_of(successors(Branch), GoesAround))
      Found.push_back(Branch);
  return Found;
}

/// The blocks from \p Block on, up to \p End, which is null for none, and up to
/// barriers.
SmallVector<BasicBlock *, 8> blocksUpTo(BasicBlock *Block, BasicBlock *End) {
  SmallVector<BasicBlock *, 8> Tail{Block};
  BlockSet Seen{Block, End};
  for (size_t N = 0; N != Tail.size(); ++N)
    for (BasicBlock *Next : successors(Tail[N]))
      if (!Barrier::hasBarrier(Next) && Seen.insert(Next).second)
        Tail.push_back(Next);
  return Tail;
}

/// Gives a way a copy of \p Tail, whose first block it enters.
void copyTail(const Way &W, ArrayRef<BasicBlock *> Tail) {
  ValueToValueMapTy Copies;
  SmallVector<BasicBlock *, 8> Copied;
  for (BasicBlock *Block : Tail) {
    Copied.push_back(
        CloneBasicBlock(Block, Copies, ".way", Block->getParent()));
    Copies[Block] = Copied.back();
  }
  remapInstructionsInBlocks(Copied, Copies);
  for (BasicBlock *Last : W.Last)
    Last->getTerminator()->replaceSuccessorWith(Tail.front(), Copied.front());
}

/// If work-items of a way may go around \p Block, its end is no place for a
/// barrier. Then each way gets a copy of what lies between there and where they
/// meet again; \p SomeEnded: ways with a barrier keep the original. LLVM makes
/// such blocks when it merges equal code at the ends of two conditionals.
bool copiedForWays(BasicBlock &Block, ArrayRef<Way> Ways, bool SomeEnded) {
  const PostDominatorTree PostDominators(*Block.getParent());
  BasicBlock *End = &Block;
  for (const Way &W : Ways)
    for (BasicBlock *Branch : partings(W, Block, PostDominators))
      if (End)
        End = PostDominators.findNearestCommonDominator(End, Branch);
  if (End == &Block)
    return false;
  const SmallVector<BasicBlock *, 8> Tail = blocksUpTo(&Block, End);
  keepInVariables(Tail);
  for (const Way &W : SomeEnded ? Ways : Ways.drop_front())
    copyTail(W, Tail);
  return true;
}

bool separateWays(BasicBlock &Block, const SimtBranches &Branches) {
  if (!Block.hasNPredecessorsOrMore(2))
    return false;
  const std::vector<Way> Ways = waysInto(Block, Branches);
  const bool SomeEnded = any_of(predecessors(&Block), [&](BasicBlock *Before) {
    return endsRegion(*Before, Branches);
  });
  if (Ways.size() + SomeEnded < 2)
    return false;
  if (copiedForWays(Block, Ways, SomeEnded))
    return true;
  for (const Way &W : Ways)
    Barrier::Create(
        SplitBlockPredecessors(&Block, W.Last, ".join")->getTerminator());
  return !Ways.empty();
}

} // namespace

PreservedAnalyses SimtJoins::run(Function &F, FunctionAnalysisManager &AM) {
  if (!isKernelToProcess(F) || !hasWorkgroupBarriers(F))
    return PreservedAnalyses::all();
  const SimtBranches Branches(F, AM.getResult<LoopAnalysis>(F),
                              AM.getResult<PostDominatorTreeAnalysis>(F));
  bool Changed = false;
  // Upper joins first: what they separate lies before the lower ones.
  const ReversePostOrderTraversal<Function *> Order(&F);
  for (BasicBlock *Block :
       std::vector<BasicBlock *>(Order.begin(), Order.end()))
    Changed |= separateWays(*Block, Branches);
  if (!Changed)
    return PreservedAnalyses::all();
  PreservedAnalyses Kept = PreservedAnalyses::none();
  Kept.preserve<VariableUniformityAnalysis>();
  Kept.preserve<WorkitemHandlerChooser>();
  return Kept;
}

REGISTER_NEW_FPASS("simt-joins", pocl::SimtJoins, "");

} // namespace pocl
