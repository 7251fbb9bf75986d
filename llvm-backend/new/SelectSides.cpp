//===- SelectSides.cpp - short sides of divergent branches become selects -===//
//
// A branch that lanes part at costs a split, a branch and a join for each side
// that is taken: six or seven instructions more than the sides. Where the sides
// are short and may be executed by all lanes, they are, and selects take the
// values. What lies on uniform branches stays there, since lanes then skip it.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "RISCVSubtarget.h"
#include "Remarks.h"
#include "llvm/ADT/PostOrderIterator.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/TargetTransformInfo.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/Instructions.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Target/TargetMachine.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/Local.h"

using namespace llvm;

namespace {

cl::opt<bool> Enabled("vorion-select-sides", cl::Hidden, cl::init(true),
                      cl::desc("Replace divergent branches around a few "
                               "instructions by selects"));

// A divergent branch with one side costs, in instructions beside the side: the
// split and its operand, then branch and join twice, 6; with two sides a jump
// more, 7. If the lanes happen to agree it is 3 or 4, and one side is skipped.
// Selects cost themselves and both sides, always. If lanes part at 60 % of the
// branches, selects are cheaper up to these limits of 5 * selects + sides.
// (What the selects cost weighs most at any share.)
constexpr unsigned SelectWeight = 5;
constexpr unsigned OneSidedLimit = 24;
constexpr unsigned TwoSidedLimit = 30;

class SideSelector {
public:
  SideSelector(BasicBlock &Head, const TargetTransformInfo &TTI,
               const RISCVSubtarget &Subtarget)
      : Head(Head), TTI(TTI), Subtarget(Subtarget) {}

  /// True if the branch at the end of Head is gone.
  bool run() {
    if (!findSides() || !isCheaper())
      return false;
    auto *Branch = cast<BranchInst>(Head.getTerminator());
    vorion::remark<OptimizationRemark>(
        vorion::remarks::Select, "Branchless", *Branch, [&] {
          return "divergent branch made branchless: " + weighed() +
                 ", against a vx_split, branches and a vx_join";
        });
    select(*Branch);
    return true;
  }

  /// Why run() leaves the branch as it is.
  std::string obstacle() {
    if (!findSides())
      return "a side is more than one block, or other code leads to it";
    if (isCheaper())
      return {};
    return Obstacle ? Obstacle
                    : weighed() + ", more than a vx_split, branches and a "
                                  "vx_join";
  }

private:
  /// False if the branch has not the form that can be replaced.
  bool findSides() {
    auto *Branch = cast<BranchInst>(Head.getTerminator());
    BasicBlock *True = Branch->getSuccessor(0),
               *False = Branch->getSuccessor(1);
    BasicBlock *TrueEnd = sideEnd(True), *FalseEnd = sideEnd(False);
    if (TrueEnd && TrueEnd == FalseEnd)
      Sides = {True, False};
    else if (TrueEnd == False)
      Sides = {True};
    else if (FalseEnd == True)
      Sides = {False};
    else
      return false;
    Meeting = Sides.size() == 2 ? TrueEnd : Sides[0] == True ? False : True;
    FromTrue = Sides[0] == True ? True : &Head;
    FromFalse = Sides.back() == False ? False : &Head;
    return Meeting != &Head;
  }

  /// Where \p Side goes on if it is a block of its own, else null.
  BasicBlock *sideEnd(BasicBlock *Side) const {
    if (Side->getSinglePredecessor() != &Head || Side->hasAddressTaken())
      return nullptr;
    const auto *Jump = dyn_cast<BranchInst>(Side->getTerminator());
    return Jump && Jump->isUnconditional() ? Jump->getSuccessor(0) : nullptr;
  }

  bool isCheaper() {
    Limit = Sides.size() == 2 ? TwoSidedLimit : OneSidedLimit;
    Cost = 0;
    for (PHINode &Phi : Meeting->phis()) {
      Value *T = Phi.getIncomingValueForBlock(FromTrue);
      Value *F = Phi.getIncomingValueForBlock(FromFalse);
      if (!oneOf(T, F))
        Cost += SelectWeight * selectCost(*T, *F);
    }
    for (const BasicBlock *Side : Sides)
      for (const Instruction &I : *Side) {
        if (I.isTerminator() || I.isDebugOrPseudoInst())
          continue;
        if (!isSafeToSpeculativelyExecute(&I)) {
          Obstacle = obstacleOf(I);
          return false;
        }
        Cost += sideCost(I);
      }
    if (!Cost.isValid())
      Obstacle = "a side has an operation that is slow, or a call";
    return Cost.isValid() && Cost <= Limit;
  }

  static const char *obstacleOf(const Instruction &I) {
    if (I.mayWriteToMemory())
      return "a side writes to memory";
    return isa<LoadInst>(I)
               ? "a side reads memory that the other lanes may not have"
               : "a side has what the other lanes may not execute";
  }

  std::string weighed() const {
    return "selects and sides weigh " + std::to_string(*Cost.getValue()) +
           ", the limit is " + std::to_string(Limit);
  }

  /// Instructions that \p I becomes; invalid if it is slow or a library call.
  InstructionCost sideCost(const Instruction &I) const {
    const Type *Kind = I.getType();
    if (Kind->isDoubleTy() || Kind->isHalfTy())
      return InstructionCost::getInvalid();
    const bool IsWide = Kind->isIntegerTy(64);
    switch (I.getOpcode()) {
    case Instruction::Add:
    case Instruction::Sub:
      return IsWide ? 4 : 1;
    case Instruction::And:
    case Instruction::Or:
    case Instruction::Xor:
      return IsWide ? 2 : 1;
    case Instruction::ICmp:
      return I.getOperand(0)->getType()->isIntegerTy(64) ? 4 : 1;
    case Instruction::Mul:
    case Instruction::Shl:
    case Instruction::LShr:
    case Instruction::AShr:
    case Instruction::FAdd:
    case Instruction::FSub:
    case Instruction::FMul:
    case Instruction::FNeg:
    case Instruction::FCmp:
    case Instruction::Trunc:
    case Instruction::ZExt:
    case Instruction::SExt:
    case Instruction::BitCast:
    case Instruction::PtrToInt:
    case Instruction::IntToPtr:
    case Instruction::GetElementPtr:
    case Instruction::Load:
    case Instruction::Freeze:
      return IsWide && !isa<CastInst, LoadInst>(I)
                 ? InstructionCost::getInvalid()
                 : TTI.getInstructionCost(
                       &I, TargetTransformInfo::TCK_SizeAndLatency);
    case Instruction::Select:
      return selectCost(*I.getOperand(1), *I.getOperand(2));
    case Instruction::Call:
      return isOneInstruction(cast<CallBase>(I))
                 ? 1
                 : InstructionCost::getInvalid();
    default:
      return InstructionCost::getInvalid();
    }
  }

  static bool isOneInstruction(const CallBase &Call) {
    if (Call.getType()->isIntegerTy(64))
      return false;
    switch (Call.getIntrinsicID()) {
    case Intrinsic::fabs:
    case Intrinsic::fma:
    case Intrinsic::copysign:
    case Intrinsic::minnum:
    case Intrinsic::maxnum:
    case Intrinsic::smin:
    case Intrinsic::smax:
    case Intrinsic::umin:
    case Intrinsic::umax:
      return true;
    default:
      return false;
    }
  }

  /// Instructions of a select: two conditional zeros and an or for a word, or
  /// one if it is between a value and 0; floats pass through integers.
  InstructionCost selectCost(const Value &T, const Value &F) const {
    Type *Kind = T.getType();
    const unsigned Words =
        divideCeil(Head.getDataLayout().getTypeSizeInBits(Kind), 32);
    // Without conditional zeros a mask is made of the condition.
    const unsigned PerWord = Subtarget.hasStdExtZicond() ? 3 : 4;
    if (Kind->isFloatTy()) {
      // A constant needs no move, and 0 no instruction of its own.
      const unsigned Moves = 1 + !isa<Constant>(T) + !isa<Constant>(F);
      return Moves + (isZero(T) || isZero(F) ? 1 : PerWord);
    }
    if (!Kind->isIntOrPtrTy())
      return InstructionCost::getInvalid();
    // Between a condition and a constant it is a logical operation.
    const bool IsLogical = Kind->isIntegerTy(1) && (isOne(T) || isOne(F));
    return Words * (isZero(T) || isZero(F) || IsLogical ? 1 : PerWord);
  }
  /// What all lanes may take where \p T or \p F would be chosen, if there is.
  static Value *oneOf(Value *T, Value *F) {
    return isa<PoisonValue>(T)             ? F
           : T == F || isa<PoisonValue>(F) ? T
                                           : nullptr;
  }

  static bool isOne(const Value &V) {
    const auto *C = dyn_cast<ConstantInt>(&V);
    return C && C->isOne();
  }
  static bool isZero(const Value &V) {
    const auto *C = dyn_cast<Constant>(&V);
    return C && C->isNullValue();
  }

  void select(BranchInst &Branch) {
    for (BasicBlock *Side : Sides)
      hoistAllInstructionsInto(&Head, &Branch, Side);
    IRBuilder<> Builder(&Branch);
    for (PHINode &Phi : Meeting->phis()) {
      Value *T = Phi.getIncomingValueForBlock(FromTrue);
      Value *F = Phi.getIncomingValueForBlock(FromFalse);
      Value *Chosen = oneOf(T, F);
      if (!Chosen)
        Chosen = Builder.CreateSelect(Branch.getCondition(), T, F);
      // The edge of the last side will be Head's.
      Phi.setIncomingValueForBlock(FromTrue, Chosen);
      Phi.setIncomingValueForBlock(FromFalse, Chosen);
    }
    if (Sides.size() == 2) {
      Meeting->replacePhiUsesWith(Sides[0], &Head);
      Meeting->removePredecessor(Sides[1], /*KeepOneInputPHIs=*/true);
    } else {
      Meeting->removePredecessor(Sides[0], /*KeepOneInputPHIs=*/true);
    }
    BranchInst::Create(Meeting, Branch.getIterator());
    Branch.eraseFromParent();
    for (BasicBlock *Side : Sides) {
      Side->getTerminator()->eraseFromParent();
      Side->eraseFromParent();
    }
    MergeBlockIntoPredecessor(Meeting);
  }

  BasicBlock &Head;
  const TargetTransformInfo &TTI;
  const RISCVSubtarget &Subtarget;
  SmallVector<BasicBlock *, 2> Sides;
  BasicBlock *Meeting = nullptr, *FromTrue = nullptr, *FromFalse = nullptr;
  InstructionCost Cost;
  unsigned Limit = 0;
  /// What forbids it, whatever it costs.
  const char *Obstacle = nullptr;
};

} // namespace

bool vorion::selectShortSides(Function &F, FunctionAnalysisManager &Analyses,
                              const RISCVSubtarget &Subtarget) {
  if (!Enabled)
    return false;
  const TargetTransformInfo &TTI = Analyses.getResult<TargetIRAnalysis>(F);
  auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  // Inner branches come first: they make the sides of outer ones shorter.
  std::vector<BasicBlock *> Heads;
  for (BasicBlock *Block : post_order(&F))
    if (branchesApart(Uniform, *Block))
      Heads.push_back(Block);
  bool Changed = false;
  for (BasicBlock *Head : Heads)
    Changed |= SideSelector(*Head, TTI, Subtarget).run();
  return Changed;
}

void vorion::remarkSidesKept(Function &F, FunctionAnalysisManager &Analyses,
                             const RISCVSubtarget &Subtarget) {
  if (!Enabled ||
      !OptimizationRemarkEmitter::allowExtraAnalysis(F, remarks::Select))
    return;
  const TargetTransformInfo &TTI = Analyses.getResult<TargetIRAnalysis>(F);
  auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  auto &Loops = Analyses.getResult<LoopAnalysis>(F);
  for (BasicBlock *Head : post_order(&F)) {
    // Branches that leave loops are never made branchless.
    const Loop *L = Loops.getLoopFor(Head);
    if (!branchesApart(Uniform, *Head) || (L && L->isLoopExiting(Head)))
      continue;
    remark<OptimizationRemarkMissed>(
        remarks::Select, "Kept", *Head->getTerminator(), [&] {
          return "divergent branch not made branchless: " +
                 SideSelector(*Head, TTI, Subtarget).obstacle();
        });
  }
}
