#include "SimtWays.h"

#include "Barrier.h"

#include <llvm/ADT/STLExtras.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Constants.h>
#include <llvm/IR/Instructions.h>

using namespace llvm;

namespace pocl {

StringRef nameOfCalled(const Value *V) {
  const auto *Call = dyn_cast<CallBase>(V);
  const Function *Callee = Call ? Call->getCalledFunction() : nullptr;
  return Callee ? Callee->getName() : StringRef();
}

/// Whether the branch always goes the first way. SimtExits makes such a
/// condition of a constant.
static bool isNeverFalse(const Instruction *Terminator) {
  const auto *Branch = dyn_cast<BranchInst>(Terminator);
  const auto *Compare = Branch && Branch->isConditional()
                            ? dyn_cast<ICmpInst>(Branch->getCondition())
                            : nullptr;
  const auto *Call =
      Compare ? dyn_cast<CallInst>(Compare->getOperand(0)) : nullptr;
  return Call && nameOfCalled(Call) == "vorion.vx_uniform" &&
         isa<ConstantInt>(Call->getArgOperand(0));
}

WaysToReturn::WaysToReturn(Function &F, const std::set<Edge> &Without) {
  findLiveEdges(F, Without);
  findPostDominators();
  BeforeBarrier = allBefore(Barrier::hasBarrier);
}

BlockSet
WaysToReturn::allBefore(function_ref<bool(BasicBlock *)> IsGoal) const {
  BlockSet Found;
  for (bool Grown = true; Grown;) {
    Grown = false;
    for (BasicBlock *Block : reverse(Blocks))
      if (!Found.contains(Block) &&
          (IsGoal(Block) || any_of(behind(Block), [&](BasicBlock *Next) {
             return Found.contains(Next);
           })))
        Grown |= Found.insert(Block).second;
  }
  return Found;
}

void WaysToReturn::findLiveEdges(Function &F, const std::set<Edge> &Without) {
  for (BasicBlock &Block : F) {
    NumberOf[&Block] = Blocks.size();
    Blocks.push_back(&Block);
  }
  Live.resize(Blocks.size());
  for (BasicBlock *Block : Blocks) {
    const bool OneWay = isNeverFalse(Block->getTerminator());
    for (BasicBlock *Next : successors(Block)) {
      if (!Without.count({Block, Next}))
        Live[number(Block)].push_back(Next);
      if (OneWay)
        break;
    }
  }
  const BlockSet Leading = allBefore([](const BasicBlock *Block) {
    return isa<ReturnInst>(Block->getTerminator());
  });
  for (auto &Ways : Live)
    erase_if(Ways, [&](BasicBlock *Next) { return !Leading.contains(Next); });
}

void WaysToReturn::findPostDominators() {
  After.assign(Blocks.size(), BitVector(Blocks.size(), true));
  for (bool Changed = true; Changed;) {
    Changed = false;
    for (size_t N = Blocks.size(); N-- != 0;) {
      BitVector Common(Blocks.size(), !Live[N].empty());
      for (BasicBlock *Next : Live[N])
        Common &= After[number(Next)];
      Common.set(N);
      if (Common != After[N]) {
        After[N] = std::move(Common);
        Changed = true;
      }
    }
  }
}

SmallVector<BasicBlock *, 8>
WaysToReturn::allBehind(const BasicBlock *Block) const {
  SmallVector<BasicBlock *, 8> Found;
  for (const unsigned Other : After[number(Block)].set_bits())
    if (Other != number(Block))
      Found.push_back(Blocks[Other]);
  // They are post-dominated one by the other.
  sort(Found, [this](const BasicBlock *A, const BasicBlock *B) {
    return After[number(A)].count() > After[number(B)].count();
  });
  return Found;
}

BasicBlock *WaysToReturn::meetingOf(const BasicBlock *Block) const {
  const auto Behind = allBehind(Block);
  return Behind.empty() ? nullptr : Behind.front();
}

} // namespace pocl
