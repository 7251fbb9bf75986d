#include "SimtBooleans.h"

#include <llvm/IR/ConstantRange.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/Metadata.h>

using namespace llvm;

namespace pocl {

namespace {

/// A bool in memory is a byte, and in a register its lowest bit; without
/// optimisation clang promises nothing of the others.
bool takeAnyByte(LoadInst &Load) {
  const MDNode *Range = Load.getMetadata(LLVMContext::MD_range);
  const ConstantRange Promise(APInt(8, 0), APInt(8, 2));
  bool Changed = Range && getConstantRangeFromMetadata(*Range) == Promise;
  if (Changed)
    Load.setMetadata(LLVMContext::MD_range, nullptr);
  for (User *U : make_early_inc_range(Load.users())) {
    auto *Bit = dyn_cast<TruncInst>(U);
    if (!Bit || !Bit->getType()->isIntegerTy(1))
      continue;
    IRBuilder<> Builder(Bit);
    Bit->replaceAllUsesWith(Builder.CreateIsNotNull(&Load));
    Bit->eraseFromParent();
    Changed = true;
  }
  return Changed;
}

} // namespace

PreservedAnalyses SimtBooleans::run(Function &F, FunctionAnalysisManager &) {
  bool Changed = false;
  SmallVector<LoadInst *, 8> Bytes;
  for (Instruction &I : instructions(F))
    if (auto *Load = dyn_cast<LoadInst>(&I);
        Load && Load->getType()->isIntegerTy(8))
      Bytes.push_back(Load);
  for (LoadInst *Load : Bytes)
    Changed |= takeAnyByte(*Load);
  if (!Changed)
    return PreservedAnalyses::all();
  PreservedAnalyses Kept = PreservedAnalyses::none();
  Kept.preserveSet<CFGAnalyses>();
  return Kept;
}

} // namespace pocl
