//===- Reconvergence.cpp - lanes wait where their paths first meet --------===//
//
// Lanes that part at a branch reconverge at its immediate post-dominator. A
// basic block that both sides reach before it is executed once for each side:
// the common default of a switch, what `a || b` guards, the target of a `goto`
// or of a case that falls through. This step makes such a block execute once.
// All edges that leave the predecessors of the block, direct or not, go to a
// new block, the hub, which then post-dominates the branch. Each edge brings
// along where it led, as a PHI node for each guard: a branch behind the hub
// that leads there.
//
// A hub has a price: the PHI nodes, and a split, a branch and a join for each
// guard. A few cheap instructions stay executed several times.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "Remarks.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/Analysis/TargetTransformInfo.h"
#include "llvm/IR/ConstantRange.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/PatternMatch.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Transforms/Utils/Local.h"
#include "llvm/Transforms/Utils/SSAUpdater.h"
#include <optional>

using namespace llvm;
using namespace llvm::PatternMatch;
using vorion::BlockSet;

namespace {

cl::opt<bool> Enabled("vorion-reconverge", cl::Hidden, cl::init(true),
                      cl::desc("Reconverge where divergent paths first meet"));

// Where lanes part, they execute the shared blocks again; where they agree, a
// hub costs its price. With lanes that part at every second branch, it is paid
// by twice as many instructions.
cl::opt<unsigned> Limit("vorion-reconverge-limit", cl::Hidden, cl::init(2),
                        cl::desc("Instructions of shared blocks for each one "
                                 "of a hub, at least"));

using BlockList = SmallVector<BasicBlock *, 8>;

/// The rerouting of all edges from a set of blocks to a list of others.
class Hub {
public:
  /// From some of \p Blocks to \p Targets, at least two, both in topological
  /// order.
  Hub(ArrayRef<BasicBlock *> Blocks, BlockList Targets,
      const BranchInst &Branch)
      : To(std::move(Targets)), Place(Branch.getDebugLoc()),
        Context(Branch.getContext()) {
    int Negated = 0;
    for (BasicBlock *Block : Blocks) {
      const unsigned Edges = count_if(successors(Block), [&](BasicBlock *Next) {
        return is_contained(To, Next);
      });
      if (Edges != 0)
        Sources.push_back(Block);
      if (Edges == 2)
        Negated += *succ_begin(Block) == To[0] ? -1 : 1;
    }
    // Conditions then serve the guard as they are.
    if (To.size() == 2 && Negated > 0)
      std::swap(To[0], To[1]);
    for (unsigned I = 1; I < To.size(); ++I)
      Guards.push_back(
          BasicBlock::Create(Context, "hub", To[0]->getParent(), To[0]));
  }

  /// The conditions of the guards.
  SmallVector<PHINode *, 4> build() {
    SmallVector<PHINode *, 4> Taken;
    for (unsigned Guard = 0; Guard < Guards.size(); ++Guard) {
      Taken.push_back(makePhi(Type::getInt1Ty(Context), "taken"));
      for (BasicBlock *Source : Sources)
        Taken.back()->addIncoming(isTaken(*Source, Guard), Source);
    }
    for (unsigned Index = 0; Index < To.size(); ++Index)
      moveValues(Index);
    for (BasicBlock *Source : Sources)
      redirect(*Source);
    for (unsigned Guard = 0; Guard < Guards.size(); ++Guard)
      BranchInst::Create(To[Guard], successorOf(Guard), Taken[Guard],
                         Guards[Guard])
          ->setDebugLoc(Place);
    return Taken;
  }

private:
  PHINode *makePhi(Type *Ty, const Twine &Name) {
    return PHINode::Create(Ty, Sources.size(), Name, Guards[0]);
  }

  BasicBlock *successorOf(unsigned Guard) const {
    return Guard + 1 < Guards.size() ? Guards[Guard + 1] : To.back();
  }

  /// Whether lanes that leave \p Source go to the target of \p Guard. No
  /// earlier guard has let them go.
  Value *isTaken(BasicBlock &Source, unsigned Guard) const {
    auto &Branch = cast<BranchInst>(*Source.getTerminator());
    SmallVector<unsigned, 2> Indices;
    for (BasicBlock *Next : successors(&Source))
      if (const auto *Found = find(To, Next); Found != To.end())
        Indices.push_back(Found - To.begin());
    if (Guard > *max_element(Indices))
      return PoisonValue::get(Type::getInt1Ty(Context));
    if (Indices.size() == 1 || Guard != *min_element(Indices))
      return ConstantInt::getBool(Context, is_contained(Indices, Guard));
    if (Indices[0] == Guard)
      return Branch.getCondition();
    return BinaryOperator::CreateNot(Branch.getCondition(), "other",
                                     Branch.getIterator());
  }

  /// Lets the values of PHI nodes in target \p Index pass through the hub.
  void moveValues(unsigned Index) {
    const unsigned Guard = std::min<unsigned>(Index, Guards.size() - 1);
    for (PHINode &Phi : make_early_inc_range(To[Index]->phis())) {
      PHINode *Moved = makePhi(Phi.getType(), Phi.getName());
      for (BasicBlock *Source : Sources)
        Moved->addIncoming(
            Phi.getBasicBlockIndex(Source) < 0
                ? PoisonValue::get(Phi.getType())
                : Phi.removeIncomingValue(Source, /*DeletePHIIfEmpty=*/false),
            Source);
      if (Phi.getNumIncomingValues() != 0) {
        Phi.addIncoming(Moved, Guards[Guard]);
        continue;
      }
      Phi.replaceAllUsesWith(Moved);
      Phi.eraseFromParent();
    }
  }

  void redirect(BasicBlock &Source) {
    auto *Branch = cast<BranchInst>(Source.getTerminator());
    if (all_of(Branch->successors(),
               [&](BasicBlock *Next) { return is_contained(To, Next); })) {
      BranchInst::Create(Guards[0], Branch->getIterator())
          ->setDebugLoc(Branch->getDebugLoc());
      Branch->eraseFromParent();
      return;
    }
    for (unsigned I = 0; I < Branch->getNumSuccessors(); ++I)
      if (is_contained(To, Branch->getSuccessor(I)))
        Branch->setSuccessor(I, Guards[0]);
  }

  BlockList To;
  DebugLoc Place;
  LLVMContext &Context;
  /// Blocks with an edge to a target.
  BlockList Sources;
  /// One less than targets. The first is the hub.
  BlockList Guards;
};

/// A hub that is worth its price.
struct Choice {
  BlockSet From;
  /// In topological order.
  BlockList To;
};

class HubFinder {
public:
  HubFinder(Function &F, FunctionAnalysisManager &Analyses)
      : Uniform(Analyses.getResult<UniformityInfoAnalysis>(F)),
        PostDominators(Analyses.getResult<PostDominatorTreeAnalysis>(F)),
        Loops(Analyses.getResult<LoopAnalysis>(F)),
        TTI(Analyses.getResult<TargetIRAnalysis>(F)) {
    const ReversePostOrderTraversal<Function *> Traversal(&F);
    Order.assign(Traversal.begin(), Traversal.end());
  }

  /// Builds hubs for branches whose regions do not overlap, outer ones first,
  /// and returns the conditions of their guards.
  ArrayRef<PHINode *> run() {
    for (BasicBlock *Block : Order)
      if (!Changed.count(Block) && vorion::branchesApart(Uniform, *Block))
        tryBranch(*Block);
    return Conditions;
  }

private:
  void tryBranch(BasicBlock &Block) {
    const Loop *L = Loops.getLoopFor(&Block);
    const auto *Node = PostDominators.getNode(&Block);
    Meeting = Node && Node->getIDom() ? Node->getIDom()->getBlock() : nullptr;
    if (!Meeting || Loops.getLoopFor(Meeting) != L ||
        (L && L->isLoopExiting(&Block)))
      return;
    Region = vorion::blocksBefore(&Block, Meeting);
    if (any_of(Region, [&](BasicBlock *Other) { return Changed.count(Other); }))
      return;
    const BlockSet Shared = vorion::sharedBlocks(Block, Meeting);
    for (BasicBlock *First : Order) {
      if (!Shared.count(First))
        continue;
      const std::optional<Choice> Found = choose(Block, *First);
      if (!Found)
        continue;
      vorion::remark<OptimizationRemark>(
          vorion::remarks::Reconverge, "Hub", *Block.getTerminator(), [&] {
            return "lanes that part here wait for each other in front of code "
                   "that several paths lead to" +
                   vorion::lineOf(*First);
          });
      append_range(Conditions, Hub(ordered(Found->From), Found->To,
                                   cast<BranchInst>(*Block.getTerminator()))
                                   .build());
      Changed.insert(Region.begin(), Region.end());
      return;
    }
  }

  /// The hub in front of \p Shared for the branch of \p Block. Its edges come
  /// from all that leads to Shared. If they then have more than two targets,
  /// they may come from all that does not follow Shared instead: the cases of a
  /// switch that do not fall through, for instance.
  std::optional<Choice> choose(BasicBlock &Block, BasicBlock &Shared) {
    const BlockSet Behind = vorion::blocksBefore(&Shared, Meeting);
    Choice Chosen{predecessorsOf(Shared, Block), {}};
    // What is inside a loop waits in front of the loop.
    if (Chosen.From.count(&Shared))
      return std::nullopt;
    Chosen.To = targetsOf(Chosen.From);
    if (Chosen.To.size() > 2) {
      Choice Wider;
      for (BasicBlock *Other : Region)
        if (!Behind.count(Other))
          Wider.From.insert(Other);
      Wider.To = targetsOf(Wider.From);
      if (Wider.To.size() < Chosen.To.size())
        Chosen = std::move(Wider);
    }
    const unsigned Ways = count_if(predecessors(&Shared), [&](auto *Before) {
      return Chosen.From.count(Before);
    });
    InstructionCost Again = 0;
    for (BasicBlock *Other : Behind)
      Again += costOf(*Other, Loops.getLoopDepth(&Block));
    if (Again * (Ways - 1) < unsigned{Limit} * priceOf(Chosen))
      return std::nullopt;
    return Chosen;
  }

  /// The blocks of the region from which paths lead to \p Block, among them the
  /// branch at \p Start, where it begins.
  BlockSet predecessorsOf(BasicBlock &Block, BasicBlock &Start) const {
    BlockSet Found;
    SmallVector<BasicBlock *, 8> Work = {&Block};
    while (!Work.empty()) {
      BasicBlock *At = Work.pop_back_val();
      if (At == &Start)
        continue;
      for (BasicBlock *Before : predecessors(At))
        if (Region.count(Before) && Found.insert(Before).second)
          Work.push_back(Before);
    }
    return Found;
  }

  /// Where edges from \p From to other blocks lead, in topological order.
  BlockList targetsOf(const BlockSet &From) const {
    BlockSet Outside;
    for (BasicBlock *Block : From)
      for (BasicBlock *Next : successors(Block))
        if (!From.count(Next))
          Outside.insert(Next);
    return ordered(Outside);
  }

  BlockList ordered(const BlockSet &Blocks) const {
    BlockList Found;
    copy_if(Order, std::back_inserter(Found),
            [&](BasicBlock *Block) { return Blocks.count(Block); });
    return Found;
  }

  /// Instructions that the hub takes if lanes agree. A branch of which both
  /// sides go to the hub needs no split any more.
  unsigned priceOf(const Choice &Hub) const {
    const unsigned Saved = count_if(Hub.From, [&](BasicBlock *Block) {
      return vorion::branchesApart(Uniform, *Block) &&
             all_of(successors(Block), [&](BasicBlock *Next) {
               return is_contained(Hub.To, Next);
             });
    });
    const unsigned Guards = Hub.To.size() - 1;
    return GuardCost * Guards - std::min(SplitCost * Saved, GuardCost * Guards);
  }

  /// Instructions that lanes execute in \p Block, which may lie in loops deeper
  /// than \p Depth.
  InstructionCost costOf(const BasicBlock &Block, unsigned Depth) const {
    InstructionCost Cost = 0;
    for (const Instruction &I : Block) {
      if (isa<PHINode>(I) || I.isDebugOrPseudoInst())
        continue;
      const auto *Call = dyn_cast<CallBase>(&I);
      if (Call && Call->isConvergent())
        Cost += ConvergentCost;
      else if (Call && !isa<IntrinsicInst>(Call))
        Cost += CallCost;
      else
        Cost +=
            TTI.getInstructionCost(&I, TargetTransformInfo::TCK_SizeAndLatency);
    }
    for (; Depth < Loops.getLoopDepth(&Block); ++Depth)
      Cost *= Rounds;
    return Cost;
  }

  /// A condition for each of two edges, split, branch and join.
  static constexpr unsigned GuardCost = 5;
  /// The same without conditions.
  static constexpr unsigned SplitCost = 3;
  /// A function of subgroups is to see all lanes that come to it.
  static constexpr unsigned ConvergentCost = 1000;
  static constexpr unsigned CallCost = 50;
  /// Iterations of a loop of which nothing is known.
  static constexpr unsigned Rounds = 8;

  UniformityInfo &Uniform;
  const PostDominatorTree &PostDominators;
  const LoopInfo &Loops;
  const TargetTransformInfo &TTI;
  /// All blocks in reverse post-order.
  std::vector<BasicBlock *> Order;
  /// From a branch until its immediate post-dominator, which is Meeting.
  BlockSet Region;
  BasicBlock *Meeting = nullptr;
  /// The regions of branches that got hubs.
  BlockSet Changed;
  SmallVector<PHINode *, 8> Conditions;
};

/// Gives values that no longer dominate all of their uses PHI nodes. They are
/// poison on the paths through a hub that no lane takes.
void repairValues(Function &F, DominatorTree &Dominators) {
  for (Instruction &I : instructions(F)) {
    SmallVector<Use *, 4> Uses;
    BasicBlock *Start = I.getParent();
    for (Use &U : I.uses()) {
      if (Dominators.dominates(&I, U))
        continue;
      Uses.push_back(&U);
      auto *User = cast<Instruction>(U.getUser());
      const auto *Phi = dyn_cast<PHINode>(User);
      Start = Dominators.findNearestCommonDominator(
          Start, Phi ? Phi->getIncomingBlock(U) : User->getParent());
    }
    if (Uses.empty())
      continue;
    SSAUpdater Values;
    Values.Initialize(I.getType(), I.getName());
    Values.AddAvailableValue(I.getParent(), &I);
    Values.AddAvailableValue(Start, PoisonValue::get(I.getType()));
    for (Use *U : Uses)
      Values.RewriteUse(*U);
  }
}

/// Whether \p A and \p B are equal (true) or opposite (false), if that is
/// known.
std::optional<bool> compare(Value *A, Value *B) {
  Value *Inner;
  if (match(A, m_Not(m_Value(Inner)))) {
    const std::optional<bool> Equal = compare(Inner, B);
    return Equal ? std::optional(!*Equal) : std::nullopt;
  }
  if (match(B, m_Not(m_Value(Inner))))
    return compare(B, A);
  if (A == B)
    return true;
  const auto *First = dyn_cast<CmpInst>(A), *Second = dyn_cast<CmpInst>(B);
  if (!First || !Second || First->getOperand(0) != Second->getOperand(0))
    return std::nullopt;
  const APInt *C, *D;
  if (match(First->getOperand(1), m_APInt(C)) &&
      match(Second->getOperand(1), m_APInt(D))) {
    const auto True =
        ConstantRange::makeExactICmpRegion(First->getPredicate(), *C);
    const auto Other =
        ConstantRange::makeExactICmpRegion(Second->getPredicate(), *D);
    if (True == Other || True == Other.inverse())
      return True == Other;
  }
  if (First->getOperand(1) != Second->getOperand(1))
    return std::nullopt;
  if (First->getPredicate() == Second->getPredicate())
    return true;
  if (First->getPredicate() == Second->getInversePredicate())
    return false;
  return std::nullopt;
}

/// LLVM threads the next test into both sides of the one before. Where the same
/// test leads to a hub on all edges, it is made once, behind the hub.
void mergeTests(PHINode &Condition, const DominatorTree &Dominators) {
  Value *First = Condition.getIncomingValue(0), *Inner = First;
  const bool IsNegated = match(First, m_Not(m_Value(Inner)));
  const auto *Test = dyn_cast<CmpInst>(Inner);
  if (!Test || any_of(Test->operands(), [&](const Use &Operand) {
        const auto *I = dyn_cast<Instruction>(Operand);
        return I && !Dominators.dominates(I, &Condition);
      }))
    return;
  const SmallVector<Value *, 8> Same(Condition.incoming_values());
  if (any_of(Same, [&](Value *Other) { return compare(First, Other) != true; }))
    return;
  auto *Merged = cast<CmpInst>(Test->clone());
  Merged->insertInto(Condition.getParent(),
                     Condition.getParent()->getFirstInsertionPt());
  // What was known of one test need not hold of all.
  Merged->dropUnknownNonDebugMetadata();
  Merged->dropPoisonGeneratingFlags();
  if (IsNegated)
    Merged->setPredicate(Test->getInversePredicate());
  Condition.replaceAllUsesWith(Merged);
  Condition.eraseFromParent();
  for (Value *Old : SmallSetVector<Value *, 8>(Same.begin(), Same.end()))
    RecursivelyDeleteTriviallyDeadInstructions(Old);
}

} // namespace

bool vorion::reconvergeEarly(Function &F, FunctionAnalysisManager &Analyses) {
  if (!Enabled)
    return false;
  HubFinder Finder(F, Analyses);
  const ArrayRef<PHINode *> Conditions = Finder.run();
  if (Conditions.empty())
    return false;
  DominatorTree Dominators(F);
  repairValues(F, Dominators);
  for (PHINode *Condition : Conditions)
    mergeTests(*Condition, Dominators);
  return true;
}
