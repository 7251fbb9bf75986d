//===- SimtRegions.cc - what the regions of a kernel share, for lanes -----===//

#include "SimtRegions.h"

#include "SimtBlocks.h"
#include "SimtSlots.h"

#include <llvm/ADT/STLExtras.h>
#include <llvm/Analysis/CaptureTracking.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>
#include <llvm/IR/PassManager.h>

// Needs the pass manager's header before it.
#include "VariableUniformityAnalysisResult.hh"

using namespace llvm;

namespace pocl {

ParallelRegion *SimtRegions::regionOf(BasicBlock *Block) const {
  for (ParallelRegion *Region : Regions)
    if (Region->HasBlock(Block))
      return Region;
  return nullptr;
}

void SimtRegions::arrangeSlots(Function &F, LoopInfo &Loops,
                               VariableUniformityAnalysisResult &Uniformity) {
  const auto Share = [this](BasicBlock *A, BasicBlock *B) {
    return any_of(Regions, [&](ParallelRegion *Region) {
      return Region->HasBlock(A) && Region->HasBlock(B);
    });
  };
  for (BasicBlock &Block : F)
    for (Instruction &I : Block)
      if (auto *Variable = dyn_cast<AllocaInst>(&I))
        if (readsApartFromWrites(Variable, Share) &&
            Uniformity.isUniform(&F, Variable))
          Shared.insert(Variable);
  shortenSlots(F, Loops, Share, [this](AllocaInst *Variable) {
    return regionOf(Variable->getParent()) && !isOfLane(Variable);
  });
}

ParallelRegion *SimtRegions::onlyRegionUsing(AllocaInst *Variable) const {
  if (!isa<ConstantInt>(Variable->getArraySize()) ||
      PointerMayBeCaptured(Variable, /*ReturnCaptures=*/true,
                           /*StoreCaptures=*/true))
    return nullptr;
  ParallelRegion *Only = nullptr;
  std::vector<Instruction *> Pending{Variable};
  std::set<Instruction *> Seen;
  while (!Pending.empty()) {
    Instruction *Pointer = Pending.back();
    Pending.pop_back();
    if (!Seen.insert(Pointer).second)
      continue;
    for (User *U : Pointer->users()) {
      auto *I = cast<Instruction>(U);
      for (ParallelRegion *Region : Regions)
        if (Region->HasBlock(I->getParent())) {
          if (Only && Only != Region)
            return nullptr;
          Only = Region;
        }
      if (I->getType()->isPointerTy() && !isa<LoadInst>(I))
        Pending.push_back(I);
    }
  }
  return Only;
}

std::set<Instruction *> SimtRegions::decisions(Function &F) const {
  std::set<Instruction *> Decisions;
  // A kernel of barriers alone has no regions.
  for (BasicBlock &Block : F)
    if (!regionOf(&Block))
      Decisions.insert(Block.getTerminator());
  for (ParallelRegion *Region : Regions)
    for (BasicBlock *Block : *Region)
      if (Block != Region->exitBB())
        for (BasicBlock *Successor : successors(Block))
          if (!Region->HasBlock(Successor))
            Decisions.insert(Block->getTerminator());
  return Decisions;
}

std::vector<SimtRegions::Doubt>
SimtRegions::doubtful(Function &F, const std::set<Instruction *> &Decisions,
                      VariableUniformityAnalysisResult &Uniformity) const {
  std::vector<Doubt> Found;
  for (BasicBlock &Block : F) {
    Instruction *Decision = Block.getTerminator();
    auto *Condition = dyn_cast_or_null<Instruction>(decidingValue(Block));
    if (!Condition || !Decisions.count(Decision) ||
        Uniformity.isUniform(&F, Condition))
      continue;
    if (regionOf(&Block))
      Found.push_back({Decision, Condition, nullptr});
    else if (ParallelRegion *Region = regionOf(Condition->getParent()))
      Found.push_back({Decision, Condition, Region->exitBB()});
  }
  return Found;
}

} // namespace pocl
