//===- RepeatedBlocks.cpp - blocks that a warp executes in passes ---------===//
//
// In `if (a && b) X; else Y;` both conditions lead to Y, and the lanes come
// there in two passes, since they meet only behind X and Y. What Y reads from
// one place may have changed between the passes, so lanes may differ in it
// afterwards although the analysis, which lets lanes meet in Y, says otherwise.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "Remarks.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/CodeGen/TargetOpcodes.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/IntrinsicInst.h"

using namespace llvm;

namespace {

/// Whether a second execution may give another result.
bool dependsOnTime(const Instruction &I) {
  if (I.getType()->isVoidTy() || isa<DbgInfoIntrinsic>(I))
    return false;
  if (const vorion::IntrinsicRecord *Ours = vorion::findIntrinsic(&I))
    return Ours->Opcode != TargetOpcode::COPY;
  return I.mayReadFromMemory();
}

} // namespace

vorion::BlockSet vorion::sharedBlocks(const BasicBlock &Block,
                                      BasicBlock *Meeting) {
  const Instruction *Branch = Block.getTerminator();
  BlockSet Shared = blocksBefore(Branch->getSuccessor(0), Meeting);
  const BlockSet Other = blocksBefore(Branch->getSuccessor(1), Meeting);
  Shared.remove_if([&](BasicBlock *Reached) { return !Other.count(Reached); });
  return Shared;
}

bool vorion::markRepeatedBlocks(Function &F, UniformityInfo &Uniform,
                                const PostDominatorTree &PostDominators) {
  SmallPtrSet<BasicBlock *, 16> Repeated;
  for (BasicBlock &Block : F) {
    if (!branchesApart(Uniform, Block))
      continue;
    const auto *Node = PostDominators.getNode(&Block);
    BasicBlock *Meeting =
        Node && Node->getIDom() ? Node->getIDom()->getBlock() : nullptr;
    const BlockSet Shared = sharedBlocks(Block, Meeting);
    Repeated.insert(Shared.begin(), Shared.end());
  }

  LLVMContext &Context = F.getContext();
  unsigned Marker = divergentMarker(Context);
  bool Changed = false;
  for (BasicBlock *Block : Repeated)
    for (Instruction &I : *Block)
      if (dependsOnTime(I) && !I.hasMetadata(Marker)) {
        I.setMetadata(Marker, MDNode::get(Context, {}));
        remark<OptimizationRemarkAnalysis>(remarks::Repeat, "Read", I, [] {
          return "both sides of a divergent branch lead here before they meet: "
                 "the warp comes once for each, and reads anew";
        });
        Changed |= Uniform.isUniform(&I);
      }
  return Changed;
}
