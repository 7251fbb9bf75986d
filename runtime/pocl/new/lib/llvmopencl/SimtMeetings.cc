#include "SimtMeetings.h"

#include "Barrier.h"
#include "LLVMUtils.h"
#include "SimtBlocks.h"
#include "SimtGuards.h"
#include "SimtInstructions.h"
#include "SimtReturns.h"
#include "SimtRounds.h"
#include "VariableUniformityAnalysisResult.hh"
#include "Workgroup.h"
#include "WorkitemHandlerChooser.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/ADT/PostOrderIterator.h>
#include <llvm/ADT/SetVector.h>
#include <llvm/Analysis/LoopInfo.h>
#include <llvm/Analysis/OptimizationRemarkEmitter.h>
#include <llvm/Analysis/PostDominators.h>
#include <llvm/IR/CFG.h>
#include <llvm/IR/Dominators.h>
#include <llvm/Transforms/Utils/Local.h>

using namespace llvm;

namespace pocl {

namespace {

using BlockList = SmallSetVector<BasicBlock *, 16>;
/// Where edges lead, and the blocks from which they come.
using Ways = MapVector<BasicBlock *, BlockList>;

/// Values are no longer chosen by the way to these blocks.
void keepChoicesInVariables(ArrayRef<BasicBlock *> Ends) {
  for (BasicBlock *End : Ends)
    while (auto *Phi = dyn_cast<PHINode>(&End->front()))
      DemotePHIToStack(Phi);
}

//===----------------------------------------------------------------------===//
// One place to meet behind a conditional
//===----------------------------------------------------------------------===//

/// Where the lanes that part at the branch meet; null if nowhere.
BasicBlock *meetingPlace(BasicBlock &Branch, const PostDominatorTree &After) {
  const auto *Node = After.getNode(&Branch);
  return Node && Node->getIDom() ? Node->getIDom()->getBlock() : nullptr;
}

/// Whether lanes that part at the branch may come to a barrier before they
/// meet.
bool mayMeetTooLate(BasicBlock &Branch, const BasicBlock *Meeting) {
  return any_of(reachedTwice(Branch, Meeting), Barrier::hasBarrier);
}

/// The blocks that are reached from a barrier on a way around the branch.
BlockSet reachedFromBarriers(BasicBlock &Branch) {
  BlockSet Seen;
  SmallVector<BasicBlock *, 16> Pending;
  const auto Follow = [&](BasicBlock &Block) {
    for (BasicBlock *Next : successors(&Block))
      if (Next != &Branch && Seen.insert(Next).second)
        Pending.push_back(Next);
  };
  for (BasicBlock &Block : *Branch.getParent())
    if (&Block != &Branch && Barrier::hasBarrier(&Block))
      Follow(Block);
  while (!Pending.empty())
    Follow(*Pending.pop_back_val());
  return Seen;
}

/// The blocks that only lanes pass that were at the branch, with no barrier
/// since, up to barriers, returns and the meeting place. The branch's own is
/// the first.
BlockList blocksBehind(BasicBlock &Branch, const BasicBlock *Meeting,
                       const DominatorTree &Dominators) {
  const BlockSet Others = reachedFromBarriers(Branch);
  BlockList Found;
  Found.insert(&Branch);
  for (size_t N = 0; N != Found.size(); ++N)
    for (BasicBlock *Next : successors(Found[N]))
      if (Next != Meeting && !succ_empty(Next) && !Barrier::hasBarrier(Next) &&
          !Others.contains(Next) && Dominators.dominates(&Branch, Next))
        Found.insert(Next);
  return Found;
}

Ways waysOutOf(const BlockList &Blocks) {
  Ways Found;
  for (BasicBlock *Block : Blocks)
    for (BasicBlock *Next : successors(Block))
      // The branch's own block may be a barrier's, to which they come again.
      if (!Blocks.contains(Next) || Barrier::hasBarrier(Next))
        Found[Next].insert(Block);
  return Found;
}

/// Whether the group agrees which of the ways it takes. It does if they lead to
/// different barriers, which all or none reach, and one to where all meet
/// otherwise.
bool agreesOn(const Ways &Out, const BasicBlock *Meeting) {
  unsigned Others = 0;
  BlockSet Barriers;
  for (const auto &Way : Out) {
    BasicBlock *End = Way.first;
    if (!Barrier::hasBarrier(End) && (End == Meeting || succ_empty(End))) {
      if (++Others > 1)
        return false;
      continue;
    }
    for (BasicBlock *Next : nextBarriers(End))
      if (!Barrier::hasBarrier(Next) || !Barriers.insert(Next).second)
        return false;
  }
  return true;
}

/// Leads all ways through one block. What it decides by is not seen through, or
/// the optimiser would lead them past it again.
BasicBlock *leadThroughOneBlock(const Ways &Out) {
  Function &F = *Out.front().first->getParent();
  auto *Meeting = BasicBlock::Create(F.getContext(), "meeting", &F);
  IRBuilder<> Builder(Meeting);
  PHINode *Way = Builder.CreatePHI(Builder.getInt32Ty(), Out.size(), "way");
  SwitchInst *Decision = Builder.CreateSwitch(createUniform(Builder, Way),
                                              Out.front().first, Out.size());
  for (const auto &[End, Sources] : Out) {
    auto *Edge = BasicBlock::Create(F.getContext(), "way", &F, Meeting);
    BranchInst::Create(Meeting, Edge);
    ConstantInt *Number = Builder.getInt32(Way->getNumIncomingValues());
    Way->addIncoming(Number, Edge);
    if (End != Decision->getDefaultDest())
      Decision->addCase(Number, End);
    for (BasicBlock *Source : Sources)
      Source->getTerminator()->replaceSuccessorWith(End, Edge);
  }
  return Meeting;
}

/// Mends the first branch whose lanes would meet too late; outer ones are
/// before inner ones. False if there is none. No branch is looked at again:
/// \p Known has those that were, because a mended one can still look bad. (If a
/// loop without end lies behind it, there is no place where all its lanes
/// meet.)
bool meetBeforeBarrier(Function &F, BlockSet &Known) {
  const DominatorTree Dominators(F);
  PostDominatorTree After(F);
  LoopInfo Loops(Dominators);
  VariableUniformityAnalysisResult Uniformity;
  Uniformity.runOnFunction(F, Loops, After);
  const ReversePostOrderTraversal<Function *> Order(&F);
  for (BasicBlock *Branch : Order) {
    Value *Condition = decidingValue(*Branch);
    if (!Condition || Uniformity.isUniform(&F, Condition))
      continue;
    BasicBlock *Meeting = meetingPlace(*Branch, After);
    if (!mayMeetTooLate(*Branch, Meeting) || !Known.insert(Branch).second)
      continue;
    const BlockList Behind = blocksBehind(*Branch, Meeting, Dominators);
    const Ways Out = waysOutOf(Behind);
    if (!agreesOn(Out, Meeting))
      continue;
    SmallVector<BasicBlock *, 4> Ends;
    for (const auto &Way : Out)
      Ends.push_back(Way.first);
    keepChoicesInVariables(Ends);
    // What the branch's own block computes still reaches every place.
    keepInVariables(Behind.getArrayRef().drop_front());
    Known.insert(leadThroughOneBlock(Out));
    return true;
  }
  return false;
}

//===----------------------------------------------------------------------===//
// Which kernels run in rounds
//===----------------------------------------------------------------------===//

/// The barriers that a way may come to before \p Meeting, and whether it may
/// come there, or to a return, without one.
struct Reach {
  BlockSet Barriers;
  bool WithoutBarrier = false;
};

Reach reachOf(BasicBlock *Next, BasicBlock *Meeting) {
  Reach Found;
  BlockSet Seen{Next};
  SmallVector<BasicBlock *, 16> Pending{Next};
  while (!Pending.empty()) {
    BasicBlock *Block = Pending.pop_back_val();
    if (Block != Meeting && Barrier::hasBarrier(Block))
      Found.Barriers.insert(Block);
    else if (Block == Meeting || succ_empty(Block))
      Found.WithoutBarrier = true;
    else
      for (BasicBlock *After : successors(Block))
        if (Seen.insert(After).second)
          Pending.push_back(After);
  }
  return Found;
}

/// Whether work-items may part at the branch although a barrier lies on one of
/// its ways: it does not follow that they come to it. Where each way leads to
/// barriers of its own, or past all of them, it does, and the group agrees.
bool partsBeforeBarriers(BasicBlock &Branch, BasicBlock *Meeting) {
  BlockSet Known;
  for (BasicBlock *Next : BlockSet(succ_begin(&Branch), succ_end(&Branch))) {
    const Reach Way = reachOf(Next, Meeting);
    if (Way.WithoutBarrier && !Way.Barriers.empty())
      return true;
    for (BasicBlock *Barrier : Way.Barriers)
      if (!Known.insert(Barrier).second)
        return true;
  }
  return false;
}

/// A block for whose branch the kernel needs rounds; null if there is none. A
/// branch that is the same for the whole group by what is known of its
/// condition is none.
BasicBlock *partingBeforeBarriers(Function &F) {
  const DominatorTree Dominators(F);
  PostDominatorTree After(F);
  LoopInfo Loops(Dominators);
  VariableUniformityAnalysisResult Uniformity;
  Uniformity.runOnFunction(F, Loops, After);
  const auto Found = find_if(F, [&](BasicBlock &Branch) {
    Value *Condition = decidingValue(Branch);
    return Condition && !Uniformity.isUniform(&F, Condition) &&
           partsBeforeBarriers(Branch, meetingPlace(Branch, After));
  });
  return Found == F.end() ? nullptr : &*Found;
}

//===----------------------------------------------------------------------===//
// A head for each loop
//===----------------------------------------------------------------------===//

/// The block with nothing in it through which all ways of a loop go back, if
/// it has several; else null.
BasicBlock *commonLatch(const Loop &L) {
  BasicBlock *Latch = L.getLoopLatch();
  const bool IsCommon = Latch && Latch->getSingleSuccessor() &&
                        !Latch->getSinglePredecessor() &&
                        Latch->getFirstNonPHIOrDbg() == Latch->getTerminator();
  return IsCommon ? Latch : nullptr;
}

/// If one way back of a loop passes a barrier and another does not, there are
/// two loops with one head: gives the outer one its own, with a barrier.
bool separateHeads(const Loop &L) {
  BasicBlock *Head = L.getHeader(), *Latch = commonLatch(L);
  BlockList Inner;
  bool HasOuter = false;
  for (BasicBlock *Before : predecessors(Latch ? Latch : Head)) {
    if (!L.contains(Before))
      continue;
    if (isReachedWithoutBarrier(Before, L))
      Inner.insert(Before);
    else
      HasOuter = true;
  }
  if (Inner.empty() || !HasOuter ||
      (Latch && !TryToSimplifyUncondBranchFromEmptyBlock(Latch)))
    return false;
  keepChoicesInVariables(Head);
  auto *OuterHead = BasicBlock::Create(Head->getContext(), "outer_head",
                                       Head->getParent(), Head);
  Barrier::Create(BranchInst::Create(Head, OuterHead));
  for (BasicBlock *Before : BlockList(pred_begin(Head), pred_end(Head)))
    if (Before != OuterHead && !Inner.contains(Before))
      Before->getTerminator()->replaceSuccessorWith(Head, OuterHead);
  return true;
}

bool separateHeads(Function &F) {
  const LoopInfo Loops{DominatorTree(F)};
  return any_of(Loops.getLoopsInPreorder(),
                [](const Loop *L) { return separateHeads(*L); });
}

/// Tells whoever listens (docs/backend.md, Remarks) why the kernel is slow, and
/// where that begins, if it is known.
void tellOfRounds(Function &F, StringRef Reason, const DebugLoc &At) {
  keepReasonOfRounds(*F.getParent(), Reason, At ? At.getLine() : 0);
  OptimizationRemarkEmitter(&F).emit([&] {
    return OptimizationRemarkMissed("vorion-returns", "Rounds", At,
                                    &F.getEntryBlock())
           << Reason
           << ": the kernel runs in rounds from barrier to barrier, which "
              "takes more time";
  });
}

/// Why a kernel in which work-items return runs in rounds.
std::string reasonOfReturns(const DebugLoc &Obstacle) {
  std::string Reason =
      "work-items may return here before a barrier to which others come";
  if (Obstacle)
    Reason += ", and those may not agree on their way to it in line " +
              std::to_string(Obstacle.getLine());
  return Reason;
}

/// For a kernel that could not be mapped to loops over work-items.
void runInRoundsAsAsked(Function &F) {
  const BasicBlock *Return = returnBeforeBarrier(F);
  tellOfRounds(F,
               "the kernel's barriers do not divide it into loops over "
               "work-items",
               Return ? Return->getTerminator()->getDebugLoc() : DebugLoc());
  runInRoundsOfSome(F);
}

PreservedAnalyses changedAll() {
  PreservedAnalyses Kept = PreservedAnalyses::none();
  Kept.preserve<WorkitemHandlerChooser>();
  return Kept;
}

} // namespace

PreservedAnalyses SimtMeetings::run(Function &F, FunctionAnalysisManager &) {
  if (!isKernelToProcess(F) || !hasWorkgroupBarriers(F))
    return PreservedAnalyses::all();
  if (areRoundsAskedFor(*F.getParent())) {
    runInRoundsAsAsked(F);
    return changedAll();
  }
  bool Changed = false;
  if (BasicBlock *Return = returnBeforeBarrier(F)) {
    const DebugLoc At = Return->getTerminator()->getDebugLoc();
    DebugLoc Obstacle;
    if (!guardReturned(F, Obstacle)) {
      tellOfRounds(F, reasonOfReturns(Obstacle), At);
      runInRoundsOfSome(F);
      return changedAll();
    }
    Changed = true;
  }
  while (separateHeads(F))
    Changed = true;
  for (BlockSet Known; meetBeforeBarrier(F, Known);)
    Changed = true;
  if (const BasicBlock *Parting = partingBeforeBarriers(F)) {
    const DebugLoc &At = Parting->getTerminator()->getDebugLoc();
    keepReasonOfRounds(*F.getParent(),
                       "work-items may part here, with a barrier on a way that "
                       "not all of the group need take",
                       At ? At.getLine() : 0);
    runInRounds(F);
    Changed = true;
  }
  if (!Changed)
    return PreservedAnalyses::all();
  return changedAll();
}

REGISTER_NEW_FPASS("simt-meetings", pocl::SimtMeetings, "");

} // namespace pocl
