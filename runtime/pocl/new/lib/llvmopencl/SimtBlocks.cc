//===- SimtBlocks.cc - blocks that a whole group runs together ------------===//

#include "SimtBlocks.h"

#include "Barrier.h"

#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/Analysis/CFG.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/IR/Instructions.h>
#include <llvm/Transforms/Utils/Local.h>

using namespace llvm;

namespace pocl {

BlockSet nextBarriers(BasicBlock *From, const BasicBlock *Without) {
  BlockSet Found, Seen{From};
  SmallVector<BasicBlock *, 16> Pending{From};
  while (!Pending.empty()) {
    BasicBlock *Block = Pending.pop_back_val();
    if (Barrier::hasBarrier(Block) || succ_empty(Block))
      Found.insert(Block);
    else
      for (BasicBlock *Next : successors(Block))
        if (Next != Without && Seen.insert(Next).second)
          Pending.push_back(Next);
  }
  return Found;
}

BlockSet reachedTwice(BasicBlock &Block, const BasicBlock *Without) {
  BlockSet Once, Twice;
  for (BasicBlock *Next : BlockSet(succ_begin(&Block), succ_end(&Block)))
    if (Next != Without)
      for (BasicBlock *End : nextBarriers(Next, Without))
        if (!Once.insert(End).second)
          Twice.insert(End);
  return Twice;
}

/// Keeps a value in a variable. If it decides a branch right behind a barrier,
/// it is read in front of that barrier, which does not change it. A read behind
/// would begin a region there, and that would take in what follows the branch.
static void keepInVariable(Instruction *I) {
  SmallVector<std::pair<Instruction *, Instruction *>, 2> Ended;
  for (User *Of : I->users())
    if (auto *End = cast<Instruction>(Of);
        End->isTerminator() && Barrier::endsWithBarrier(End->getParent()))
      Ended.push_back({End->getPrevNode(), End});
  DemoteRegToStack(*I);
  for (const auto &[Last, End] : Ended)
    while (Last->getNextNode() != End)
      Last->getNextNode()->moveBefore(Last);
}

void keepInVariables(ArrayRef<BasicBlock *> Blocks) {
  SmallVector<Instruction *, 8> Leaving;
  for (BasicBlock *Block : Blocks)
    for (Instruction &I : *Block)
      if (I.isUsedOutsideOfBlock(Block))
        Leaving.push_back(&I);
  for (Instruction *I : Leaving)
    keepInVariable(I);
}

bool hasIrreducibleLoops(const Function &F, const LoopInfo &Loops) {
  const ReversePostOrderTraversal<const Function *> Blocks(&F);
  return containsIrreducibleCFG<const BasicBlock *>(Blocks, Loops);
}

/// Blocks that run as often as one with a barrier: with the whole group.
static std::vector<BasicBlock *>
blocksOfWholeGroup(Function &F, LoopInfo &Loops,
                   PostDominatorTree &PostDominators) {
  std::vector<BasicBlock *> Found;
  if (hasIrreducibleLoops(F, Loops))
    return Found;
  const DominatorTree Dominators(F);
  std::vector<BasicBlock *> WithBarrier;
  for (BasicBlock &Block : F)
    if (Barrier::hasBarrier(&Block))
      WithBarrier.push_back(&Block);
  for (BasicBlock &Block : F) {
    const auto RunsAsOftenAs = [&](BasicBlock *Other) {
      return Loops.getLoopFor(&Block) == Loops.getLoopFor(Other) &&
             ((Dominators.dominates(&Block, Other) &&
               PostDominators.dominates(Other, &Block)) ||
              (Dominators.dominates(Other, &Block) &&
               PostDominators.dominates(&Block, Other)));
    };
    if (any_of(WithBarrier, RunsAsOftenAs))
      Found.push_back(&Block);
  }
  return Found;
}

bool isReachedWithoutBarrier(BasicBlock *Block, const Loop &L) {
  BlockSet Seen{L.getHeader()};
  SmallVector<BasicBlock *, 16> Pending{L.getHeader()};
  while (!Pending.empty()) {
    BasicBlock *Reached = Pending.pop_back_val();
    if (Barrier::hasBarrier(Reached))
      continue;
    if (Reached == Block)
      return true;
    for (BasicBlock *Next : successors(Reached))
      if (L.contains(Next) && Seen.insert(Next).second)
        Pending.push_back(Next);
  }
  return false;
}

Value *decidingValue(BasicBlock &Block) {
  if (auto *Branch = dyn_cast<BranchInst>(Block.getTerminator()))
    return Branch->isConditional() ? Branch->getCondition() : nullptr;
  if (auto *Switch = dyn_cast<SwitchInst>(Block.getTerminator()))
    return Switch->getCondition();
  return nullptr;
}

SimtBlocks::SimtBlocks(Function &F, LoopInfo &Loops,
                       PostDominatorTree &PostDominators) {
  for (BasicBlock *Block : blocksOfWholeGroup(F, Loops, PostDominators))
    OfWholeGroup.insert(Block);
  // Ferrante, Ottenstein and Warren, "The program dependence graph and its use
  // in optimization" (1987): what post-dominates a successor of a branch, but
  // not the branch. A loop depends on its exits, its header included.
  for (BasicBlock &Block : F) {
    Value *Condition = decidingValue(Block);
    const auto *Branch = PostDominators.getNode(&Block);
    if (!Condition || !Branch)
      continue;
    Dependence Found{&Block, Condition, {}};
    for (BasicBlock *Successor : successors(&Block))
      for (const auto *Node = PostDominators.getNode(Successor);
           Node && Node != Branch->getIDom(); Node = Node->getIDom())
        if (Node->getBlock())
          Found.Blocks.insert(Node->getBlock());
    Dependences.push_back(std::move(Found));
  }
}

bool SimtBlocks::findMore(function_ref<bool(Value *)> Agree) {
  const size_t Before = OfSome.size();
  for (const Dependence &D : Dependences)
    if (OfSome.count(D.Branch) || !Agree(D.Condition))
      for (BasicBlock *Block : D.Blocks)
        if (!OfWholeGroup.count(Block))
          OfSome.insert(Block);
  return OfSome.size() != Before;
}

} // namespace pocl
