#include "SimtExits.h"

#include "LLVMUtils.h"
#include "SimtInstructions.h"
#include "UnifyExits.h"
#include "VariableUniformityAnalysis.h"
#include "WorkitemHandlerChooser.h"

#include <llvm/Analysis/LoopInfo.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>

using namespace llvm;

namespace pocl {

namespace {

/// A function that does what the intrinsic \p Callee does, which vorion-clang
/// inlines; as a call it may return for all that is known.
Function *wrapperOf(Function &Callee) {
  Module &M = *Callee.getParent();
  const std::string Name = ("simt_" + Callee.getName()).str();
  if (Function *Known = M.getFunction(Name))
    return Known;
  auto *Wrapper = Function::Create(Callee.getFunctionType(),
                                   GlobalValue::InternalLinkage, Name, M);
  Wrapper->addFnAttr(Attribute::AlwaysInline);
  Wrapper->addFnAttr(Attribute::NoUnwind);
  IRBuilder<> Builder(BasicBlock::Create(M.getContext(), "entry", Wrapper));
  SmallVector<Value *, 1> Arguments(make_pointer_range(Wrapper->args()));
  Builder.CreateCall(&Callee, Arguments);
  Builder.CreateUnreachable();
  return Wrapper;
}

/// Behind a call that does not return nothing can follow, not even an edge that
/// is never taken: simplifycfg cuts it off. So no call is known not to.
bool forgetNoReturn(Function &F) {
  bool Changed = false;
  for (Instruction &I : instructions(F)) {
    auto *Call = dyn_cast<CallInst>(&I);
    if (!Call || !Call->doesNotReturn())
      continue;
    if (isa<IntrinsicInst>(Call))
      Call->setCalledFunction(wrapperOf(*Call->getCalledFunction()));
    else if (Function *Callee = Call->getCalledFunction())
      Callee->removeFnAttr(Attribute::NoReturn);
    Call->removeFnAttr(Attribute::NoReturn);
    Changed = true;
  }
  return Changed;
}

/// A switch whose default is never taken takes a case for the default.
bool giveSwitchesDefaults(Function &F) {
  bool Changed = false;
  for (BasicBlock &Block : F) {
    auto *Switch = dyn_cast<SwitchInst>(Block.getTerminator());
    if (!Switch || Switch->getNumCases() == 0 ||
        !isa<UnreachableInst>(Switch->getDefaultDest()->getFirstNonPHI()))
      continue;
    Switch->getDefaultDest()->removePredecessor(&Block);
    const auto Last = std::prev(Switch->case_end());
    Switch->setDefaultDest(Last->getCaseSuccessor());
    Switch->removeCase(Last);
    Changed = true;
  }
  if (Changed)
    EliminateUnreachableBlocks(F);
  return Changed;
}

} // namespace

PreservedAnalyses SimtExits::run(Function &F, FunctionAnalysisManager &) {
  if (!isKernelToProcess(F))
    return PreservedAnalyses::all();
  bool Changed = giveSwitchesDefaults(F);
  Changed |= vorion::trapAtUnreachable(F);
  Changed |= forgetNoReturn(F);
  Changed |= vorion::unifyExits(
      F, LoopInfo(DominatorTree(F)), /*Known=*/false, [](IRBuilder<> &Builder) {
        Value *One = createUniform(Builder, Builder.getInt32(1));
        return Builder.CreateICmpNE(One, Builder.getInt32(0));
      });
  if (!Changed)
    return PreservedAnalyses::all();
  PreservedAnalyses Kept = PreservedAnalyses::none();
  Kept.preserve<WorkitemHandlerChooser>();
  return Kept;
}

REGISTER_NEW_FPASS("simt-exits", pocl::SimtExits, "");

} // namespace pocl
