//===- SimtBarriers.cc - barriers among work-items on lanes ---------------===//

#include "SimtBarriers.h"

#include "Barrier.h"
#include "SimtBlocks.h"
#include "SimtInstructions.h"
#include "SimtWorkitems.h"
#include "VariableUniformityAnalysis.h"
#include "VariableUniformityAnalysisResult.hh"

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InlineAsm.h>

#include <vector>

using namespace llvm;

namespace pocl {

bool lowerSimtBarriers(Function &F) {
  std::vector<Instruction *> Barriers;
  for (BasicBlock &Block : F)
    for (Instruction &I : Block)
      if (isa<Barrier>(&I))
        Barriers.push_back(&I);
  // Loops over work-items begin with one of their own.
  const bool Needed = fitsOneWarp(*F.getParent());
  for (Instruction *I : Barriers) {
    if (Needed && !isa<ReturnInst>(I->getNextNode())) {
      IRBuilder<> Builder(I);
      createGroupBarrier(Builder);
    }
    I->eraseFromParent();
  }
  return !Barriers.empty();
}

/// Keeps the optimiser from leading ways past this place or copying it, as a
/// barrier does, but makes no code.
static void createAnchor(Instruction *Before) {
  IRBuilder<> Builder(Before);
  CallInst *Anchor = Builder.CreateCall(
      InlineAsm::get(FunctionType::get(Builder.getVoidTy(), false), "", "",
                     /*hasSideEffects=*/true));
  Anchor->addFnAttr(Attribute::Convergent);
  Anchor->addFnAttr(Attribute::NoDuplicate);
  Anchor->addFnAttr(Attribute::NoMerge);
}

/// Whether work-items may go on in the loop without others of their group.
static bool mayGoOnApart(const Loop &L,
                         VariableUniformityAnalysisResult &Uniformity) {
  SmallVector<BasicBlock *, 8> Latches, Exits;
  L.getLoopLatches(Latches);
  L.getExitingBlocks(Exits);
  Function *F = L.getHeader()->getParent();
  return any_of(Latches,
                [&](BasicBlock *Latch) {
                  return isReachedWithoutBarrier(Latch, L);
                }) &&
         any_of(Exits, [&](BasicBlock *Exit) {
           Value *Condition = decidingValue(*Exit);
           return Condition && !Uniformity.isUniform(F, Condition);
         });
}

static void anchorBarrierLoops(ArrayRef<Loop *> Loops,
                               VariableUniformityAnalysisResult &Uniformity) {
  for (Loop *L : Loops) {
    const bool HasBarrier = any_of(L->blocks(), [](BasicBlock *Block) {
      return any_of(*Block, [](Instruction &I) { return isa<Barrier>(&I); });
    });
    if (!HasBarrier)
      continue;
    const bool Apart = mayGoOnApart(*L, Uniformity);
    Instruction *Head = L->getHeader()->getFirstNonPHI();
    if (Apart)
      createAnchor(Head);
    else
      Barrier::Create(Head);
    anchorBarrierLoops(L->getSubLoops(), Uniformity);
  }
}

void anchorBarrierLoops(Function &F, LoopInfo &Loops,
                        PostDominatorTree &PostDominators) {
  VariableUniformityAnalysisResult Uniformity;
  Uniformity.runOnFunction(F, Loops, PostDominators);
  anchorBarrierLoops(Loops.getTopLevelLoops(), Uniformity);
}

SimtBranches::SimtBranches(Function &F, LoopInfo &Loops,
                           PostDominatorTree &PostDominators) {
  if (!simtLanes(*F.getParent()))
    return;
  VariableUniformityAnalysisResult Uniformity;
  Uniformity.runOnFunction(F, Loops, PostDominators);
  for (BasicBlock &Block : F) {
    const Instruction *Terminator = Block.getTerminator();
    Value *Condition = decidingValue(Block);
    if (!Condition)
      continue;
    bool Leaves = false;
    for (Loop *L = Loops.getLoopFor(&Block); L; L = L->getParentLoop())
      Leaves |= L->isLoopExiting(&Block);
    const bool Decides = Leaves || (Uniformity.isUniform(&F, Condition) &&
                                    reachedTwice(Block).empty());
    (Decides ? Deciding : OfRegion).insert(Terminator);
  }
}

} // namespace pocl
