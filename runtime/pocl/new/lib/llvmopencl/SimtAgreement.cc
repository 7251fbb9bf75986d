//===- SimtAgreement.cc - what the work-items of a group agree on ---------===//

#include "SimtAgreement.h"

#include "SimtWorkitems.h"

#include <llvm/IR/Intrinsics.h>

using namespace llvm;

namespace pocl {

Agreement::Agreement(IRBuilder<> &Builder)
    : Number(createLaneVariable(Builder, Builder.getInt32Ty(), "common")),
      Any(createLaneVariable(Builder, Builder.getInt1Ty(), "any_goes")) {}

void Agreement::begin(IRBuilder<> &Builder, Value *With) const {
  Builder.CreateStore(With, Number);
  Builder.CreateStore(Builder.getTrue(), Any);
}

/// Whether any lane has its bit in a ballot.
static Value *isAny(IRBuilder<> &Builder, Value *Lanes) {
  return Builder.CreateICmpNE(Lanes, Builder.getInt32(0));
}

/// Adds a pass to those in which somebody goes. Whether one before it was such.
Value *Agreement::noteAny(IRBuilder<> &Builder, Value *PassGoes) const {
  Value *AnyBefore =
      Builder.CreateSelect(createIsFirstPass(Builder), Builder.getFalse(),
                           Builder.CreateLoad(Builder.getInt1Ty(), Any));
  Builder.CreateStore(Builder.CreateOr(AnyBefore, PassGoes), Any);
  return AnyBefore;
}

void Agreement::ask(IRBuilder<> &Builder, Value *Goes) const {
  noteAny(Builder, isAny(Builder, createBallot(Builder, Goes)));
}

BasicBlock *Agreement::vote(BasicBlock *Block, Value *Own, Value *Goes,
                            const DebugLoc &At) const {
  IRBuilder<> Builder(Block);
  Value *Lanes = createBallot(Builder, Goes);
  Value *PassGoes = isAny(Builder, Lanes);
  Value *First =
      Builder.CreateBinaryIntrinsic(Intrinsic::cttz, Lanes, Builder.getFalse());
  Value *OfPass = createFromLane(Builder, Own, First);
  Value *Before = Builder.CreateLoad(Builder.getInt32Ty(), Number);
  Value *AnyBefore = noteAny(Builder, PassGoes);
  Builder.CreateStore(Builder.CreateSelect(PassGoes, OfPass, Before), Number);
  Value *Differs = Builder.CreateOr(
      Builder.CreateICmpNE(Own, OfPass),
      Builder.CreateAnd(AnyBefore, Builder.CreateICmpNE(Before, OfPass)));
  Value *Others = createBallot(Builder, Builder.CreateAnd(Goes, Differs));
  Function *F = Block->getParent();
  auto *Other = BasicBlock::Create(F->getContext(), "other_way", F);
  auto *Agreed = BasicBlock::Create(F->getContext(), "agreed", F);
  Builder.CreateCondBr(isAny(Builder, Others), Other, Agreed);
  createTrap(*Other, Agreed, At);
  return Agreed;
}

Value *Agreement::result(IRBuilder<> &Builder, Value *None) const {
  return createOfGroup(
      Builder, Builder.CreateSelect(
                   Builder.CreateLoad(Builder.getInt1Ty(), Any),
                   Builder.CreateLoad(Builder.getInt32Ty(), Number), None));
}

Value *Agreement::hasResult(IRBuilder<> &Builder) const {
  Value *Word = Builder.CreateZExt(Builder.CreateLoad(Builder.getInt1Ty(), Any),
                                   Builder.getInt32Ty());
  return Builder.CreateICmpNE(createOfGroup(Builder, Word),
                              Builder.getInt32(0));
}

} // namespace pocl
