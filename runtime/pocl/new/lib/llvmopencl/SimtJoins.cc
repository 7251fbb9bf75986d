#include "SimtJoins.h"

#include "Barrier.h"
#include "LLVMUtils.h"
#include "SimtWorkitems.h"
#include "VariableUniformityAnalysis.h"
#include "Workgroup.h"
#include "WorkitemHandlerChooser.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/ADT/SmallPtrSet.h>
#include <llvm/IR/CFG.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

using namespace llvm;

namespace pocl {

namespace {

using Blocks = SmallPtrSet<BasicBlock *, 16>;

/// The ways into a block that belong to one region.
struct Way {
  Blocks Region; ///< of which \c Last are the last blocks
  SmallVector<BasicBlock *, 4> Last;
};

/// Whether nothing of a region lies between the block's last barrier and its
/// end.
bool endsRegion(BasicBlock &Block, const SimtBranches &Branches) {
  return Barrier::endsWithBarrier(&Block) &&
         !Branches.mayDivide(Block.getTerminator());
}

/// All blocks from which \p Last is reached without a barrier, itself included.
Blocks regionBefore(BasicBlock *Last, const SimtBranches &Branches) {
  Blocks Region{Last};
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
  for (BasicBlock *Last : Blocks(pred_begin(&Block), pred_end(&Block))) {
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

bool separateWays(BasicBlock &Block, const SimtBranches &Branches) {
  if (!Block.hasNPredecessorsOrMore(2))
    return false;
  const std::vector<Way> Ways = waysInto(Block, Branches);
  const bool SomeEnded = any_of(predecessors(&Block), [&](BasicBlock *Before) {
    return endsRegion(*Before, Branches);
  });
  if (Ways.size() + SomeEnded < 2)
    return false;
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
