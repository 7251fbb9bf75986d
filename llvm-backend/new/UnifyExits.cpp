//===- UnifyExits.cpp - one return ----------------------------------------===//
//
// Lanes meet at a branch's immediate post-dominator, so every path must lead to
// one place. Lanes that reach `unreachable` have no further business: they wait
// at the return. A loop without end gets an exit that is never taken.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;

void vorion::unifyExits(Function &F, FunctionAnalysisManager &Analyses) {
  SmallVector<BasicBlock *, 4> Ends;
  for (BasicBlock &Block : F)
    if (isa<ReturnInst, UnreachableInst>(Block.getTerminator()))
      Ends.push_back(&Block);
  SmallVector<Loop *, 2> Endless;
  for (Loop *L : Analyses.getResult<LoopAnalysis>(F).getLoopsInPreorder())
    if (L->hasNoExitBlocks())
      Endless.push_back(L);
  if (Ends.size() + Endless.size() <= 1)
    return;

  LLVMContext &Context = F.getContext();
  BasicBlock *Return = BasicBlock::Create(Context, "return", &F);
  PHINode *Value = nullptr;
  if (!F.getReturnType()->isVoidTy())
    Value = PHINode::Create(F.getReturnType(), Ends.size(), "result", Return);
  ReturnInst::Create(Context, Value, Return);
  auto addSource = [&](BasicBlock *From, llvm::Value *Result) {
    if (Value)
      Value->addIncoming(Result ? Result : PoisonValue::get(Value->getType()),
                         From);
  };

  for (BasicBlock *End : Ends) {
    Instruction *Old = End->getTerminator();
    auto *OldReturn = dyn_cast<ReturnInst>(Old);
    addSource(End, OldReturn ? OldReturn->getReturnValue() : nullptr);
    BranchInst::Create(Return, Old->getIterator())
        ->setDebugLoc(Old->getDebugLoc());
    Old->eraseFromParent();
  }
  for (Loop *L : Endless) {
    // Any block of the loop will do; one with a single successor is simplest,
    // and a loop all of whose blocks branch has one after splitting an edge.
    BasicBlock *Header = L->getHeader();
    BasicBlock *From = BasicBlock::Create(Context, "endless", &F, Header);
    for (BasicBlock *Latch : SmallVector<BasicBlock *, 4>(predecessors(Header)))
      if (L->contains(Latch))
        Latch->getTerminator()->replaceSuccessorWith(Header, From);
    BranchInst::Create(Header, Return, ConstantInt::getTrue(Context), From);
    for (PHINode &Phi : Header->phis()) {
      PHINode *Merged =
          PHINode::Create(Phi.getType(), 2, Phi.getName(), From->begin());
      for (unsigned I = Phi.getNumIncomingValues(); I-- > 0;)
        if (L->contains(Phi.getIncomingBlock(I))) {
          Merged->addIncoming(Phi.getIncomingValue(I), Phi.getIncomingBlock(I));
          Phi.removeIncomingValue(I, /*DeletePHIIfEmpty=*/false);
        }
      Phi.addIncoming(Merged, From);
    }
    addSource(From, nullptr);
  }
}
