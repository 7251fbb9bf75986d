//===- InsertSplits.cpp - splits, joins and predicates --------------------===//
//
// A divergent branch gets a vx_split before it and a vx_join, of the split's
// token, where its sides meet: at its immediate post-dominator.
//
// If all paths from the split to that place are its own, they get a block for
// the join before it. Else paths may reach the place without having come
// through the split (to the `else` of `a && b`, whose second condition is not
// asked by all). vx_join does nothing if its token is the depth of the
// divergence stack, so on those paths the token must be the depth there. A
// split with a predicate that is false everywhere pushes nothing and returns
// the depth; it gives the token its first value where the paths part (the
// nearest common dominator of split and join), and a new one behind each split
// that is passed after that and still open at the join.
//
// Joins at one place go in the reverse order of their splits, inner before
// outer; reverse post-order puts every split before those it can lead to.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "Reasons.h"
#include "Remarks.h"
#include "Resources.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/SSAUpdater.h"

using namespace llvm;
using vorion::BlockSet;

namespace {

struct Split {
  BranchInst *Branch;
  BasicBlock *Meeting;
  CallInst *Token = nullptr;

  BasicBlock *block() const { return Branch->getParent(); }
};

class SplitInserter {
public:
  SplitInserter(Function &F, FunctionAnalysisManager &Analyses)
      : F(F), M(*F.getParent()),
        Uniform(Analyses.getResult<UniformityInfoAnalysis>(F)),
        Dominators(Analyses.getResult<DominatorTreeAnalysis>(F)),
        PostDominators(Analyses.getResult<PostDominatorTreeAnalysis>(F)),
        Loops(Analyses.getResult<LoopAnalysis>(F)) {}

  void run() {
    if (!collect())
      return;
    tell();
    separateMeetings();
    for (unsigned Index = 0; Index < Splits.size(); ++Index)
      Meetings[Splits[Index].Meeting].push_back(Index);
    for (const Split &S : Splits)
      Open.push_back(vorion::blocksBefore(S.block(), S.Meeting));
    for (Split &S : Splits)
      S.Token = callBefore(S.Branch, "vx_split", condition(S.Branch));
    for (auto &[Meeting, Here] : Meetings)
      insertJoins(Meeting, Here);
    for (auto &[L, Exit] : PredicatedLoops)
      insertPredicate(*L, Exit);
  }

private:
  CallInst *callBefore(Instruction *Before, StringRef Name,
                       ArrayRef<Value *> Arguments = {}) {
    CallInst *Call = CallInst::Create(vorion::declareIntrinsic(M, Name),
                                      Arguments, "", Before->getIterator());
    Call->setDebugLoc(F.getSubprogram() ? Before->getDebugLoc() : DebugLoc());
    return Call;
  }

  Value *condition(BranchInst *Branch) {
    IRBuilder<> Builder(Branch);
    return Builder.CreateZExt(Branch->getCondition(), Builder.getInt32Ty());
  }

  Value *zero() {
    return ConstantInt::get(Type::getInt32Ty(F.getContext()), 0);
  }

  /// Sorts the divergent branches into splits, by where they meet, and
  /// predicated loops.
  bool collect() {
    bool Good = true;
    for (BasicBlock *Block : ReversePostOrderTraversal<Function *>(&F)) {
      if (!vorion::branchesApart(Uniform, *Block))
        continue;
      auto *Branch = cast<BranchInst>(Block->getTerminator());
      Loop *L = Loops.getLoopFor(Block);
      if (L && L->isLoopExiting(Block)) {
        if (vorion::soleExit(*L, Dominators) == Branch &&
            L->getLoopPreheader()) {
          PredicatedLoops.push_back({L, Branch});
          continue;
        }
        vorion::refuse(*Branch, "a loop that lanes leave at different places");
        Good = false;
        continue;
      }
      const auto *Node = PostDominators.getNode(Block);
      BasicBlock *Meeting =
          Node && Node->getIDom() ? Node->getIDom()->getBlock() : nullptr;
      if (!Meeting || Loops.getLoopFor(Meeting) != L ||
          Loops.isLoopHeader(Meeting)) {
        vorion::refuse(*Branch, "a branch after which lanes do not meet");
        Good = false;
        continue;
      }
      Splits.push_back({Branch, Meeting});
    }
    return Good;
  }

  /// Tells who listens of every branch that lanes part at, and why they do.
  void tell() {
    if (!vorion::wantsResources() && !OptimizationRemarkEmitter(&F).enabled())
      return;
    const vorion::Reasons Why(F, Uniform, Loops);
    for (const Split &S : Splits)
      tellOf(*S.Branch, placeOf(*S.Branch), "split", vorion::remarks::Split,
             "lanes may part at this branch: vx_split before it, and vx_join "
             "where its sides meet" +
                 vorion::lineOf(*S.Meeting),
             Why.of(*S.Branch));
    for (auto &[L, Exit] : PredicatedLoops) {
      const bool OfItems = isLoopOfItems(*Exit);
      tellOf(*Exit, OfItems ? vorion::placeOf(F) : placeOf(*Exit), "predicate",
             vorion::remarks::Loop,
             "lanes may leave this loop at different times: vx_pred in every "
             "iteration",
             OfItems ? vorion::Reason{{"the size of the group, which need not "
                                       "be a multiple of the lanes' number",
                                       DebugLoc(), ""}}
                     : Why.of(*Exit));
    }
  }

  void tellOf(const BranchInst &Branch, const DebugLoc &Place, StringRef Kind,
              const char *Pass, const std::string &What,
              const vorion::Reason &Why) {
    const BasicBlock &Block = *Branch.getParent();
    vorion::remark<OptimizationRemark>(Pass, "Inserted", Place, Block,
                                       [&] { return What; });
    vorion::remark<OptimizationRemarkAnalysis>(Pass, "Why", Place, Block, [&] {
      return vorion::sentence(Why, Place);
    });
    if (vorion::wantsResources())
      vorion::noteDivergentBranch(Branch, Kind, Place, Why);
  }

  /// Whether \p Exit ends the loop over a group's work-items, which no line of
  /// the source has; nor has the latch of a rebuilt loop, which reads a note.
  bool isLoopOfItems(const BranchInst &Exit) const {
    return F.hasFnAttribute("vorion-kernel") && !Exit.getDebugLoc() &&
           !isa<PHINode>(Exit.getCondition());
  }

  /// Where \p Branch is, or what stands for it: the condition, the loop that it
  /// leaves, the function.
  DebugLoc placeOf(const BranchInst &Branch) const {
    if (Branch.getDebugLoc())
      return Branch.getDebugLoc();
    const auto *Condition = dyn_cast<Instruction>(Branch.getCondition());
    if (Condition && Condition->getDebugLoc())
      return Condition->getDebugLoc();
    const Loop *L = Loops.getLoopFor(Branch.getParent());
    if (L && L->isLoopExiting(Branch.getParent()) && L->getStartLoc())
      return L->getStartLoc();
    return vorion::placeOf(F);
  }

  /// Gives splits whose paths are all their own a meeting place of their own.
  /// Outer ones first: what is inside moves along.
  void separateMeetings() {
    for (Split &S : Splits) {
      if (Dominators.dominates(S.block(), S.Meeting))
        continue;
      BlockSet Own = vorion::blocksBefore(S.block(), S.Meeting);
      if (any_of(Own, [&](BasicBlock *Block) {
            return !Dominators.dominates(S.block(), Block);
          }))
        continue;
      SmallVector<BasicBlock *, 4> Last;
      for (BasicBlock *Block : predecessors(S.Meeting))
        if (Own.count(Block))
          Last.push_back(Block);
      BasicBlock *Shared = S.Meeting;
      BasicBlock *Meeting =
          SplitBlockPredecessors(Shared, Last, ".meet", &Dominators, &Loops);
      for (Split &Inner : Splits)
        if (Inner.Meeting == Shared && Own.count(Inner.block()))
          Inner.Meeting = Meeting;
    }
  }

  void insertJoins(BasicBlock *Meeting, ArrayRef<unsigned> Here) {
    Instruction *Before = &*Meeting->getFirstInsertionPt();
    for (unsigned Index : reverse(Here))
      callBefore(Before, "vx_join", tokenAt(Meeting, Index));
  }

  /// The token of split \p Index as it is at \p Meeting, on whatever path.
  Value *tokenAt(BasicBlock *Meeting, unsigned Index) {
    Split &S = Splits[Index];
    if (Dominators.dominates(S.block(), Meeting))
      return S.Token;

    SSAUpdater Token;
    Token.Initialize(S.Token->getType(), "token");
    Token.AddAvailableValue(S.block(), S.Token);
    BasicBlock *Start =
        Dominators.findNearestCommonDominator(S.block(), Meeting);
    while (Loops.getLoopFor(Start) != Loops.getLoopFor(Meeting))
      Start = Dominators.getNode(Start)->getIDom()->getBlock();
    Token.AddAvailableValue(Start, depthBehind(Start));
    for (unsigned Other = 0; Other < Splits.size(); ++Other) {
      BasicBlock *Block = Splits[Other].block();
      if (Other != Index && Block != Start &&
          Dominators.dominates(Start, Block) && isOpenAt(Other, Index))
        Token.AddAvailableValue(Block, depthBehind(Block));
    }
    return Token.GetValueInMiddleOfBlock(Meeting);
  }

  /// Whether a path that has come through split \p Other may reach the join of
  /// split \p Index before Other's own.
  bool isOpenAt(unsigned Other, unsigned Index) {
    if (Splits[Other].Meeting == Splits[Index].Meeting)
      return Other < Index;
    return Open[Other].count(Splits[Index].Meeting);
  }

  /// The depth of the divergence stack at the end of \p Block, behind its split
  /// if it has one.
  CallInst *depthBehind(BasicBlock *Block) {
    CallInst *&Depth = Depths[Block];
    if (!Depth)
      Depth = callBefore(Block->getTerminator(), "vx_split", zero());
    return Depth;
  }

  /// Lanes that leave \p L wait at the exit until all have.
  void insertPredicate(const Loop &L, BranchInst *Exit) {
    CallInst *Mask =
        callBefore(L.getLoopPreheader()->getTerminator(), "vx_active_threads");
    bool StaysIfTrue = L.contains(Exit->getSuccessor(0));
    callBefore(Exit, StaysIfTrue ? "vx_pred" : "vx_pred_n",
               {condition(Exit), Mask});
  }

  Function &F;
  Module &M;
  UniformityInfo &Uniform;
  DominatorTree &Dominators;
  const PostDominatorTree &PostDominators;
  LoopInfo &Loops;
  /// In reverse post-order.
  std::vector<Split> Splits;
  /// Where lanes may be while a split is open.
  std::vector<BlockSet> Open;
  MapVector<BasicBlock *, SmallVector<unsigned, 2>> Meetings;
  DenseMap<BasicBlock *, CallInst *> Depths;
  SmallVector<std::pair<Loop *, BranchInst *>, 4> PredicatedLoops;
};

} // namespace

void vorion::insertSplits(Function &F, FunctionAnalysisManager &Analyses) {
  SplitInserter(F, Analyses).run();
}
