//===- SimtInstructions.cc - instructions that only lanes need ------------===//

#include "SimtInstructions.h"

#include "UnifyExits.h"

using namespace llvm;

namespace pocl {

FunctionCallee intrinsic(Module &M, StringRef Name, Type *Result,
                         ArrayRef<Type *> Parameters) {
  FunctionCallee Callee =
      M.getOrInsertFunction(Name, FunctionType::get(Result, Parameters, false));
  if (auto *Decl = dyn_cast<Function>(Callee.getCallee())) {
    Decl->addFnAttr(Attribute::Convergent);
    Decl->addFnAttr(Attribute::NoMerge);
    Decl->addFnAttr(Attribute::NoUnwind);
  }
  return Callee;
}

void createGroupBarrier(IRBuilder<> &Builder) {
  Type *I32 = Builder.getInt32Ty();
  FunctionCallee Bar =
      intrinsic(*Builder.GetInsertBlock()->getModule(), "vorion.vx_bar",
                Builder.getVoidTy(), {I32, I32});
  Builder.CreateCall(Bar, {Builder.getInt32(0), Builder.getInt32(1)})
      ->addFnAttr(Attribute::NoDuplicate);
}

Value *createUniform(IRBuilder<> &Builder, Value *Word) {
  Type *I32 = Builder.getInt32Ty();
  return Builder.CreateCall(intrinsic(*Builder.GetInsertBlock()->getModule(),
                                      "vorion.vx_uniform", I32, {I32}),
                            {Word});
}

Value *createBallot(IRBuilder<> &Builder, Value *Condition) {
  Type *I32 = Builder.getInt32Ty();
  return Builder.CreateCall(intrinsic(*Builder.GetInsertBlock()->getModule(),
                                      "vorion.vx_vote_ballot", I32, {I32}),
                            {Builder.CreateZExt(Condition, I32)});
}

Value *createFromLane(IRBuilder<> &Builder, Value *Word, Value *Lane) {
  Type *I32 = Builder.getInt32Ty();
  // In one segment, of all lanes.
  Value *Control = Builder.CreateOr(Lane, Builder.getInt32(63 << 6));
  return Builder.CreateCall(intrinsic(*Builder.GetInsertBlock()->getModule(),
                                      "vorion.vx_shfl_idx", I32, {I32, I32}),
                            {Word, Control});
}

/// Marks a value as createOfGroup() says.
static constexpr const char *GroupValue = "simt.group";

/// The first lane has a work-item in every pass. Those that have none in the
/// last pass do not know what came of it.
Value *createOfGroup(IRBuilder<> &Builder, Value *Word) {
  Value *Of = createUniform(Builder,
                            createFromLane(Builder, Word, Builder.getInt32(0)));
  cast<Instruction>(Of)->setMetadata(GroupValue,
                                     MDNode::get(Builder.getContext(), {}));
  return Of;
}

bool isOfGroup(const Value &V) {
  const auto *I = dyn_cast<Instruction>(&V);
  return I && I->hasMetadata(GroupValue);
}

/// Marks a variable as createLaneVariable() says.
static constexpr const char *LaneVariable = "simt.lane";

AllocaInst *createLaneVariable(IRBuilder<> &Builder, Type *T,
                               const char *Name) {
  AllocaInst *Variable = Builder.CreateAlloca(T, nullptr, Name);
  Variable->setMetadata(LaneVariable, MDNode::get(Builder.getContext(), {}));
  return Variable;
}

bool isLaneVariable(const AllocaInst &Variable) {
  return Variable.hasMetadata(LaneVariable);
}

void createTrap(BasicBlock &Block, BasicBlock *Next, const DebugLoc &At) {
  IRBuilder<> Builder(&Block);
  Builder.SetCurrentDebugLocation(At);
  vorion::createTrap(Builder);
  Builder.CreateBr(Next);
}

} // namespace pocl
