//===- UnifyExits.cpp - one return that every path leads to ---------------===//
//
// Lanes meet at a branch's immediate post-dominator. A dead end on one side of
// a branch has none in common with the other side, so that all lanes which ever
// came to the branch would meet at the end of the function only: past every
// barrier, and though no lane ever goes to the dead end. An edge from it to
// where the other paths meet puts that right. Values stay defined where they
// are used: the edge starts in what the branch dominates and leads to what
// post-dominates the branch without it, and whatever dominates that, but stands
// behind the branch, would post-dominate the branch earlier.
//
//===----------------------------------------------------------------------===//

#include "UnifyExits.h"
#include "llvm/ADT/DepthFirstIterator.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/Instructions.h"

using namespace llvm;

namespace {

/// The block of \p F's only return, made if there is none or several.
BasicBlock *mergeReturns(Function &F) {
  SmallVector<ReturnInst *, 4> Returns;
  for (BasicBlock &Block : F)
    if (auto *Return = dyn_cast<ReturnInst>(Block.getTerminator()))
      Returns.push_back(Return);
  if (Returns.size() == 1)
    return Returns.front()->getParent();
  LLVMContext &Context = F.getContext();
  BasicBlock *Merged = BasicBlock::Create(Context, "return", &F);
  PHINode *Value = nullptr;
  if (!F.getReturnType()->isVoidTy())
    Value =
        PHINode::Create(F.getReturnType(), Returns.size(), "result", Merged);
  ReturnInst::Create(Context, Value, Merged);
  for (ReturnInst *Return : Returns) {
    if (Value)
      Value->addIncoming(Return->getReturnValue(), Return->getParent());
    BranchInst::Create(Merged, Return->getIterator())
        ->setDebugLoc(Return->getDebugLoc());
    Return->eraseFromParent();
  }
  return Merged;
}

bool reaches(BasicBlock *From, BasicBlock *To, BasicBlock *Without) {
  df_iterator_default_set<BasicBlock *, 16> Seen;
  Seen.insert(Without);
  return is_contained(depth_first_ext(From, Seen), To);
}

/// The first block that every path from \p From to \p Return passes. It stands
/// on any one of them.
BasicBlock *meetingAfter(BasicBlock *From, BasicBlock *Return) {
  auto Path = df_begin(From);
  while (*Path != Return)
    ++Path;
  for (unsigned I = 1; I < Path.getPathLength(); ++I)
    if (!reaches(From, Return, Path.getPath(I)))
      return Path.getPath(I);
  llvm_unreachable("the last block of the path is the return");
}

struct DeadEnd {
  BasicBlock *Start;   ///< ends in `unreachable`, or is the endless loop's head
  const Loop *Endless; ///< null if it is no loop
  BasicBlock *Meeting;
};

/// For an edge from the block that \p Builder is at, which nothing takes: its
/// values do not matter.
void addValues(IRBuilder<> &Builder, BasicBlock *To, bool Known) {
  for (PHINode &Phi : To->phis()) {
    Value *Any = PoisonValue::get(Phi.getType());
    if (!Known)
      Any = Builder.Insert(new FreezeInst(Any));
    Phi.addIncoming(Any, Builder.GetInsertBlock());
  }
}

void leaveLoop(const DeadEnd &End, bool Known,
               function_ref<Value *(IRBuilder<> &)> MakeTrue) {
  BasicBlock *Header = End.Start;
  BasicBlock *From = BasicBlock::Create(Header->getContext(), "endless",
                                        Header->getParent(), Header);
  for (BasicBlock *Latch : SmallVector<BasicBlock *, 4>(predecessors(Header)))
    if (End.Endless->contains(Latch))
      Latch->getTerminator()->replaceSuccessorWith(Header, From);
  for (PHINode &Phi : Header->phis()) {
    PHINode *Merged =
        PHINode::Create(Phi.getType(), 2, Phi.getName(), From->end());
    for (unsigned I = Phi.getNumIncomingValues(); I-- > 0;)
      if (End.Endless->contains(Phi.getIncomingBlock(I))) {
        Merged->addIncoming(Phi.getIncomingValue(I), Phi.getIncomingBlock(I));
        Phi.removeIncomingValue(I, /*DeletePHIIfEmpty=*/false);
      }
    Phi.addIncoming(Merged, From);
  }
  IRBuilder<> Builder(From);
  addValues(Builder, End.Meeting, Known);
  Builder.CreateCondBr(MakeTrue(Builder), Header, End.Meeting);
}

} // namespace

bool vorion::unifyExits(Function &F, const LoopInfo &Loops, bool Known,
                        function_ref<Value *(IRBuilder<> &)> MakeTrue) {
  const size_t Blocks = F.size();
  SmallVector<DeadEnd, 4> DeadEnds;
  for (BasicBlock &Block : F)
    if (isa<UnreachableInst>(Block.getTerminator()))
      DeadEnds.push_back({&Block, nullptr, nullptr});
  for (const Loop *L : Loops.getLoopsInPreorder())
    if (L->hasNoExitBlocks())
      DeadEnds.push_back({L->getHeader(), L, nullptr});

  BasicBlock *Return = mergeReturns(F);
  if (DeadEnds.empty())
    return F.size() != Blocks;
  SmallPtrSet<BasicBlock *, 16> Returning;
  for (BasicBlock *Block : inverse_depth_first(Return))
    Returning.insert(Block);
  const DominatorTree Dominators(F);
  for (DeadEnd &End : DeadEnds) {
    const DomTreeNode *Node = Dominators.getNode(End.Start);
    while (Node && !Returning.count(Node->getBlock()))
      Node = Node->getIDom();
    End.Meeting = Node ? meetingAfter(Node->getBlock(), Return) : Return;
  }
  for (const DeadEnd &End : DeadEnds) {
    if (End.Endless) {
      leaveLoop(End, Known, MakeTrue);
      continue;
    }
    Instruction *Old = End.Start->getTerminator();
    IRBuilder<> Builder(Old);
    addValues(Builder, End.Meeting, Known);
    Builder.CreateBr(End.Meeting);
    Old->eraseFromParent();
  }
  return true;
}
