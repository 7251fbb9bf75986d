//===- PassLoops.cpp - how many passes a round of the loop over them has --===//
//
// Two additions and a branch lead to the next pass, which is much beside a pass
// of a few instructions. A round of several passes shares them, and what two
// passes have in common, such as their row of a group of two dimensions. Longer
// passes stay alone: copies only make the code longer.
//
//===----------------------------------------------------------------------===//

#include "PassLoops.h"
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/AssumptionCache.h"
#include "llvm/Analysis/CodeMetrics.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/Analysis/TargetTransformInfo.h"
#include "llvm/IR/Constants.h"
#include "llvm/Support/CommandLine.h"

using namespace llvm;

namespace {

cl::opt<unsigned> RoundLimit("vorion-round-limit", cl::Hidden, cl::init(64),
                             cl::desc("Instructions of a round of several "
                                      "passes over a group, at most"));

/// A split, its operand and a join.
constexpr unsigned BranchCost = 3;

/// Instructions of a pass; invalid if it cannot be copied.
InstructionCost passCost(const Loop &L, const TargetTransformInfo &TTI,
                         AssumptionCache &Assumptions) {
  SmallPtrSet<const Value *, 32> OnlyAssumed;
  CodeMetrics::collectEphemeralValues(&L, &Assumptions, OnlyAssumed);
  CodeMetrics Metrics;
  unsigned Branches = 0;
  for (const BasicBlock *Block : L.blocks()) {
    Metrics.analyzeBasicBlock(Block, TTI, OnlyAssumed, false, &L);
    Branches += succ_size(Block) - 1;
  }
  if (Metrics.notDuplicatable || Metrics.Convergence != ConvergenceKind::None ||
      Metrics.NumCalls != 0)
    return InstructionCost::getInvalid();
  return Metrics.NumInsts + BranchCost * (Branches - 1);
}

/// Passes a round, a power of two that divides their number.
unsigned passesPerRound(const Loop &L, ScalarEvolution &Evolution,
                        const TargetTransformInfo &TTI,
                        AssumptionCache &Assumptions) {
  if (!L.isInnermost() || !L.isLoopSimplifyForm() ||
      L.getExitingBlock() != L.getLoopLatch())
    return 1;
  const unsigned Passes = Evolution.getSmallConstantTripCount(&L);
  const InstructionCost Cost = passCost(L, TTI, Assumptions);
  if (Passes == 0 || !Cost.isValid())
    return 1;
  unsigned Count = 1;
  while (Passes % (2 * Count) == 0 &&
         Cost * (2 * Count) <= unsigned{RoundLimit})
    Count *= 2;
  return Count;
}

} // namespace

PreservedAnalyses
vorion::UnrollPassLoops::run(Function &F, FunctionAnalysisManager &Analyses) {
  if (F.hasOptSize())
    return PreservedAnalyses::all();
  LLVMContext &Context = F.getContext();
  auto &Loops = Analyses.getResult<LoopAnalysis>(F);
  for (Loop *L : Loops.getLoopsInPreorder()) {
    if (!getBooleanLoopAttribute(L, PassLoop))
      continue;
    const unsigned Count =
        passesPerRound(*L, Analyses.getResult<ScalarEvolutionAnalysis>(F),
                       Analyses.getResult<TargetIRAnalysis>(F),
                       Analyses.getResult<AssumptionAnalysis>(F));
    if (Count == 1)
      continue;
    Metadata *Unrolled[] = {MDString::get(Context, "llvm.loop.unroll.count"),
                            ConstantAsMetadata::get(ConstantInt::get(
                                Type::getInt32Ty(Context), Count))};
    L->setLoopID(makePostTransformationMetadata(
        Context, L->getLoopID(), {"llvm.loop.unroll."},
        {MDNode::get(Context, Unrolled)}));
  }
  return PreservedAnalyses::all();
}
