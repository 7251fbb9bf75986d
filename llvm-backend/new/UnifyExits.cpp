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
// Several branches may go to one dead end. Where the sides of the first of them
// meet, a later one may follow, and the edge would close a loop through it. The
// dead end is copied then, a copy an edge that leads to it: each belongs to one
// branch.
//
//===----------------------------------------------------------------------===//

#include "UnifyExits.h"
#include "llvm/ADT/DepthFirstIterator.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/CFG.h"
#include "llvm/IR/Constants.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/Instructions.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/Cloning.h"
#include "llvm/Transforms/Utils/Local.h"

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
  BasicBlock *Branch;  ///< the last that all came from and some return from
  BasicBlock *Meeting;
};

using BlockSet = SmallPtrSet<BasicBlock *, 16>;

/// The blocks from which a path leads to \p Return.
BlockSet returningBlocks(BasicBlock *Return) {
  BlockSet Returning;
  for (BasicBlock *Block : inverse_depth_first(Return))
    Returning.insert(Block);
  return Returning;
}

SmallVector<DeadEnd, 4> findDeadEnds(Function &F, const LoopInfo &Loops,
                                     BasicBlock *Return) {
  SmallVector<DeadEnd, 4> DeadEnds;
  for (BasicBlock &Block : F)
    if (isa<UnreachableInst>(Block.getTerminator()))
      DeadEnds.push_back({&Block, nullptr, nullptr, nullptr});
  for (const Loop *L : Loops.getLoopsInPreorder())
    if (L->hasNoExitBlocks())
      DeadEnds.push_back({L->getHeader(), L, nullptr, nullptr});
  if (DeadEnds.empty())
    return DeadEnds;
  const BlockSet Returning = returningBlocks(Return);
  const DominatorTree Dominators(F);
  for (DeadEnd &End : DeadEnds) {
    const DomTreeNode *Node = Dominators.getNode(End.Start);
    while (Node && !Returning.count(Node->getBlock()))
      Node = Node->getIDom();
    End.Branch = Node ? Node->getBlock() : nullptr;
    End.Meeting = Node ? meetingAfter(End.Branch, Return) : Return;
  }
  return DeadEnds;
}

/// Whether the edge from \p End to its meeting closes a loop that does not pass
/// its branch.
bool closesLoop(const DeadEnd &End) {
  return End.Branch && reaches(End.Meeting, End.Start, End.Branch);
}

/// Copies what \p Target leads to, for the edges from \p From only. Nothing of
/// it leads to a return, so that its values are used in it alone.
void copyDeadEnd(BasicBlock *From, BasicBlock *Target) {
  ValueToValueMapTy Copies;
  SmallVector<BasicBlock *, 4> Copied;
  const SmallVector<BasicBlock *, 4> Blocks(depth_first(Target));
  for (BasicBlock *Block : Blocks) {
    BasicBlock *Copy =
        CloneBasicBlock(Block, Copies, ".copy", Block->getParent());
    Copies[Block] = Copy;
    Copied.push_back(Copy);
  }
  remapInstructionsInBlocks(Copied, Copies);
  From->getTerminator()->replaceSuccessorWith(Target,
                                              cast<BasicBlock>(Copies[Target]));
  for (BasicBlock *Copy : Copied) {
    const BlockSet Sources(pred_begin(Copy), pred_end(Copy));
    for (PHINode &Phi : Copy->phis())
      Phi.removeIncomingValueIf(
          [&](unsigned I) { return !Sources.count(Phi.getIncomingBlock(I)); },
          /*DeletePHIIfEmpty=*/false);
  }
}

/// A copy of \p End for each edge that leads from a block of some path to
/// \p Return to one of none.
void copyForEachBranch(const DeadEnd &End, BasicBlock *Return) {
  const BlockSet Returning = returningBlocks(Return);
  const auto Passed = [&](BasicBlock *Block) {
    return Returning.count(Block) != 0;
  };
  SmallVector<BasicBlock *, 8> Leading(inverse_depth_first(End.Start));
  erase_if(Leading, Passed);
  for (BasicBlock *Target : Leading) {
    SmallSetVector<BasicBlock *, 4> Branches(pred_begin(Target),
                                             pred_end(Target));
    Branches.remove_if(std::not_fn(Passed));
    for (BasicBlock *From : Branches)
      copyDeadEnd(From, Target);
  }
  EliminateUnreachableBlocks(*End.Start->getParent());
}

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

CallInst *vorion::createTrap(IRBuilder<> &Builder) {
  return Builder.CreateCall(
      InlineAsm::get(FunctionType::get(Builder.getVoidTy(), false), "unimp", "",
                     /*hasSideEffects=*/true));
}

bool vorion::trapAtUnreachable(Function &F) {
  bool Changed = false;
  for (BasicBlock &Block : F) {
    auto *End = dyn_cast<UnreachableInst>(Block.getTerminator());
    if (!End)
      continue;
    const auto *Call =
        dyn_cast_or_null<CallBase>(End->getPrevNonDebugInstruction());
    if (Call && Call->doesNotReturn())
      continue;
    IRBuilder<> Builder(End);
    createTrap(Builder);
    Changed = true;
  }
  return Changed;
}

bool vorion::unifyExits(Function &F, const LoopInfo &Loops, bool Known,
                        function_ref<Value *(IRBuilder<> &)> MakeTrue) {
  const size_t Blocks = F.size();
  BasicBlock *Return = mergeReturns(F);
  SmallVector<DeadEnd, 4> DeadEnds = findDeadEnds(F, Loops, Return);
  LoopInfo LoopsOfCopies;
  for (auto *End = find_if(DeadEnds, closesLoop); End != DeadEnds.end();
       End = find_if(DeadEnds, closesLoop)) {
    copyForEachBranch(*End, Return);
    LoopsOfCopies.releaseMemory();
    LoopsOfCopies.analyze(DominatorTree(F));
    DeadEnds = findDeadEnds(F, LoopsOfCopies, Return);
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
  return !DeadEnds.empty() || F.size() != Blocks;
}
