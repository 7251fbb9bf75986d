//===- MergeLoopExits.cpp - loops that lanes leave apart ------------------===//
//
// vx_pred can keep lanes that have left a loop waiting only where every lane
// passes in every iteration. A loop with other exits is rebuilt: each exit, and
// the old backedge, goes to a new latch with a note of where it wants to go on;
// the latch repeats the loop or leaves it, and behind it the notes are read.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "Remarks.h"
#include "llvm/ADT/MapVector.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"

using namespace llvm;

BranchInst *vorion::soleExit(const Loop &L, const DominatorTree &Dominators) {
  BasicBlock *Exiting = L.getExitingBlock();
  BasicBlock *Latch = L.getLoopLatch();
  if (!Exiting || !Latch || !Dominators.dominates(Exiting, Latch))
    return nullptr;
  // An exit inside an inner loop is passed as often as that loop runs.
  for (const Loop *Inner : L.getSubLoops())
    if (Inner->contains(Exiting))
      return nullptr;
  auto *Branch = dyn_cast<BranchInst>(Exiting->getTerminator());
  return Branch && Branch->isConditional() ? Branch : nullptr;
}

/// Whether lanes that part at \p Block all come to \p Meeting in the same
/// iteration of \p L.
static bool meetInIteration(const Loop &L, BasicBlock *Block,
                            BasicBlock *Meeting) {
  if (!Meeting || !L.contains(Meeting))
    return false;
  SmallPtrSet<BasicBlock *, 16> Seen;
  Seen.insert(Meeting);
  SmallVector<BasicBlock *, 8> Work = {Block};
  while (!Work.empty()) {
    BasicBlock *At = Work.pop_back_val();
    if (!Seen.insert(At).second)
      continue;
    for (BasicBlock *Successor : successors(At)) {
      if (Successor == L.getHeader())
        return false;
      Work.push_back(Successor);
    }
  }
  return true;
}

bool vorion::loopIsInStep(const Loop &L, UniformityInfo &Uniform,
                          const PostDominatorTree &PostDominators,
                          const DominatorTree &Dominators) {
  if (soleExit(L, Dominators))
    return true;
  return all_of(L.blocks(), [&](BasicBlock *Block) {
    if (!branchesApart(Uniform, *Block))
      return true;
    const auto *Node = PostDominators.getNode(Block);
    return meetInIteration(L, Block,
                           Node && Node->getIDom() ? Node->getIDom()->getBlock()
                                                   : nullptr);
  });
}

namespace {

/// The rebuilding of one loop.
class LatchBuilder {
public:
  explicit LatchBuilder(Loop &L)
      : L(L), Header(L.getHeader()), Context(Header->getContext()),
        Latch(block("loop.latch")), Leave(block("loop.leave")) {}

  void build() {
    collectEdges();
    routeEdges();
    carryHeaderValues();
    for (auto &[Target, Sources] : Exits)
      carryExitValues(Target, Sources);
    buildLatch();
    buildDispatch();
  }

private:
  BasicBlock *block(const Twine &Name) {
    return BasicBlock::Create(Context, Name, Header->getParent());
  }

  /// Two edges of one branch may lead to the latch with different notes, so
  /// each edge gets a block of its own.
  BasicBlock *route(BasicBlock *From, BasicBlock *To) {
    BasicBlock *Edge = block("loop.edge");
    From->getTerminator()->replaceSuccessorWith(To, Edge);
    BranchInst::Create(Latch, Edge);
    Routed.push_back(Edge);
    return Edge;
  }

  void collectEdges() {
    for (BasicBlock *Block : L.blocks())
      for (BasicBlock *Successor : successors(Block))
        if (!L.contains(Successor))
          Exits[Successor].push_back({Block, nullptr});
  }

  void routeEdges() {
    OldLatch = L.getLoopLatch();
    BackEdge = route(OldLatch, Header);
    for (auto &[Target, Sources] : Exits)
      for (auto &[From, Edge] : Sources)
        Edge = route(From, Target);
  }

  /// A value that only some edges into the latch bring along.
  PHINode *carry(Type *Ty, const Twine &Name) {
    PHINode *Phi = PHINode::Create(Ty, Routed.size(), Name, Latch);
    for (BasicBlock *Edge : Routed)
      Phi->addIncoming(PoisonValue::get(Ty), Edge);
    return Phi;
  }

  void carryHeaderValues() {
    for (PHINode &Phi : Header->phis()) {
      PHINode *Next = carry(Phi.getType(), Phi.getName() + ".next");
      Next->setIncomingValueForBlock(BackEdge,
                                     Phi.getIncomingValueForBlock(OldLatch));
      Phi.setIncomingValueForBlock(OldLatch, Next);
      Phi.replaceIncomingBlockWith(OldLatch, Latch);
    }
  }

  using SourceList = SmallVector<std::pair<BasicBlock *, BasicBlock *>, 4>;

  void carryExitValues(BasicBlock *Target, const SourceList &Sources) {
    for (PHINode &Phi : Target->phis()) {
      PHINode *Out = carry(Phi.getType(), Phi.getName() + ".out");
      for (auto &[From, Edge] : Sources) {
        int Index = Phi.getBasicBlockIndex(From);
        Out->setIncomingValueForBlock(Edge, Phi.getIncomingValue(Index));
        Phi.removeIncomingValue(Index, /*DeletePHIIfEmpty=*/false);
      }
      // The block is filled in when the dispatch is built.
      Phi.addIncoming(Out, Leave);
    }
  }

  void buildLatch() {
    Type *Bit = Type::getInt1Ty(Context);
    PHINode *Repeat = PHINode::Create(Bit, Routed.size(), "loop.repeat", Latch);
    for (BasicBlock *Edge : Routed)
      Repeat->addIncoming(ConstantInt::getBool(Context, Edge == BackEdge),
                          Edge);
    if (Exits.size() > 1) {
      Type *Number = Type::getInt32Ty(Context);
      Which = carry(Number, "loop.which");
      unsigned Next = 0;
      for (auto &[Target, Sources] : Exits) {
        for (auto &[From, Edge] : Sources)
          Which->setIncomingValueForBlock(Edge, ConstantInt::get(Number, Next));
        ++Next;
      }
    }
    BranchInst::Create(Header, Leave, Repeat, Latch);
  }

  void buildDispatch() {
    BasicBlock *At = Leave;
    unsigned Number = 0;
    for (auto &[Target, Sources] : Exits) {
      for (PHINode &Phi : Target->phis())
        Phi.replaceIncomingBlockWith(Leave, At);
      IRBuilder<> Builder(At);
      if (++Number == Exits.size()) {
        Builder.CreateBr(Target);
        return;
      }
      BasicBlock *Next = block("loop.leave");
      Builder.CreateCondBr(
          Builder.CreateICmpEQ(Which, Builder.getInt32(Number - 1)), Target,
          Next);
      At = Next;
    }
  }

  Loop &L;
  BasicBlock *Header;
  LLVMContext &Context;
  BasicBlock *Latch, *Leave;
  BasicBlock *OldLatch = nullptr, *BackEdge = nullptr;
  SmallVector<BasicBlock *, 8> Routed;
  /// Exit block -> (block that leaves, block of the edge).
  MapVector<BasicBlock *, SourceList> Exits;
  PHINode *Which = nullptr;
};

} // namespace

bool vorion::mergeLoopExits(Function &F, FunctionAnalysisManager &Analyses) {
  auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  auto &Loops = Analyses.getResult<LoopAnalysis>(F);
  const auto &PostDominators = Analyses.getResult<PostDominatorTreeAnalysis>(F);
  const auto &Dominators = Analyses.getResult<DominatorTreeAnalysis>(F);
  SmallVector<Loop *, 4> OutOfStep;
  for (Loop *L : Loops.getLoopsInPreorder())
    if (!loopIsInStep(*L, Uniform, PostDominators, Dominators))
      OutOfStep.push_back(L);
  // Inner loops first: their exits become branches of the outer ones, which
  // wait for the next round. Loops apart do not share blocks or exits.
  for (Loop *L : OutOfStep)
    if (none_of(OutOfStep, [&](Loop *Other) {
          return Other != L && L->contains(Other);
        })) {
      remark<OptimizationRemark>(
          remarks::Loop, "Merged", L->getStartLoc(), *L->getHeader(), [&] {
            SmallVector<BasicBlock *, 4> Exiting;
            L->getExitingBlocks(Exiting);
            return "lanes leave this loop apart, at one of " +
                   std::to_string(Exiting.size()) +
                   " places: all ways out go through a new latch that every "
                   "iteration passes";
          });
      LatchBuilder(*L).build();
    }
  return !OutOfStep.empty();
}
