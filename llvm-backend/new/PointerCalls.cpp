//===- PointerCalls.cpp - calls of functions in which lanes may differ ----===//
//
// A warp jumps to one place. Where lanes may differ in the function that a
// pointer stands for, a loop calls the functions one after the other: each time
// that of the first lane that still waits, for all lanes that call the same.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "llvm/ADT/SmallVector.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"

using namespace llvm;

/// The value of \p Word in the first active lane.
static Value *ofFirstLane(IRBuilder<> &Builder, Value *Word) {
  Module &M = *Builder.GetInsertBlock()->getModule();
  const auto Call = [&](StringRef Name, ArrayRef<Value *> Operands) {
    return Builder.CreateCall(vorion::declareIntrinsic(M, Name), Operands);
  };
  Value *Active = Call("vx_vote_ballot", Builder.getInt32(1));
  Value *First = Builder.CreateAnd(Active, Builder.CreateNeg(Active));
  // No instruction counts zeros; a float holds a power of two exactly.
  Value *Exponent = Builder.CreateLShr(
      Builder.CreateBitCast(Builder.CreateUIToFP(First, Builder.getFloatTy()),
                            Builder.getInt32Ty()),
      23);
  Value *Lane = Builder.CreateSub(Exponent, Builder.getInt32(127));
  // Bits 11:6 are the last lane of all from which the shuffle may read.
  Value *From = Builder.CreateOr(Lane, Builder.getInt32(63 << 6));
  return Call("vx_uniform", Call("vx_shfl_idx", {Word, From}));
}

static void callInTurn(CallInst &Call) {
  BasicBlock *Before = Call.getParent();
  BasicBlock *After = SplitBlock(Before, std::next(Call.getIterator()));
  LLVMContext &Context = Call.getContext();
  Function *F = Call.getFunction();
  BasicBlock *Choose = BasicBlock::Create(Context, "choose", F, After);
  BasicBlock *Same = BasicBlock::Create(Context, "same", F, After);
  BasicBlock *Next = BasicBlock::Create(Context, "next", F, After);
  Before->getTerminator()->setSuccessor(0, Choose);

  IRBuilder<> Builder(Choose);
  Builder.SetCurrentDebugLocation(Call.getDebugLoc());
  Value *Target = Call.getCalledOperand();
  Value *Own = Builder.CreatePtrToInt(Target, Builder.getInt32Ty());
  Value *Chosen = ofFirstLane(Builder, Own);
  Value *Calls = Builder.CreateICmpEQ(Own, Chosen);
  Builder.CreateCondBr(Calls, Same, Next);

  Builder.SetInsertPoint(Same);
  Value *Function = Builder.CreateIntToPtr(Chosen, Target->getType());
  Builder.CreateBr(Next);
  Call.moveBefore(Same->getTerminator());
  Call.setCalledOperand(Function);

  Builder.SetInsertPoint(Next);
  if (!Call.getType()->isVoidTy()) {
    PHINode *Result = Builder.CreatePHI(Call.getType(), 2);
    Call.replaceAllUsesWith(Result);
    Result->addIncoming(PoisonValue::get(Call.getType()), Choose);
    Result->addIncoming(&Call, Same);
  }
  Builder.CreateCondBr(Calls, After, Choose);
}

bool vorion::callPointersInTurn(Function &F, UniformityInfo &Uniform) {
  SmallVector<CallInst *, 8> Calls;
  for (Instruction &I : instructions(F)) {
    auto *Call = dyn_cast<CallInst>(&I);
    if (Call && Call->isIndirectCall() &&
        Uniform.isDivergent(Call->getCalledOperand()))
      Calls.push_back(Call);
  }
  for (CallInst *Call : Calls)
    callInTurn(*Call);
  return !Calls.empty();
}
