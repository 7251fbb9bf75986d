//===- UniformTests.cpp - tests of lane addresses that lanes agree in -----===//
//
// Strength reduction ends loops by comparing an address that moves with the
// one where it stops. Lanes differ in both, by the same distance: the test's
// result is the same for all, which the uniformity analysis, looking at one
// value at a time, cannot see. Equality of p and q is equality of p - q and 0,
// so it is enough that lanes agree in the difference.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "LowerDivergence.h"
#include "Remarks.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/Analysis/ScalarEvolutionExpressions.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Instructions.h"
#include "llvm/Support/CommandLine.h"

using namespace llvm;

static cl::opt<bool>
    Enabled("vorion-uniform-tests", cl::Hidden, cl::init(true),
            cl::desc("Find comparisons of addresses that lanes agree in"));

namespace {

/// Whether lanes that are active together agree in \p S at \p At. Behind a loop
/// they may have different numbers of iterations behind them.
bool agreeIn(const SCEV *S, const BasicBlock *At, const UniformityInfo &Uniform,
             const LoopInfo &Loops) {
  const auto isLeft = [At](const Loop *L) { return L && !L->contains(At); };
  return !SCEVExprContains(S, [&](const SCEV *Part) {
    if (const auto *Leaf = dyn_cast<SCEVUnknown>(Part)) {
      const auto *I = dyn_cast<Instruction>(Leaf->getValue());
      return Uniform.isDivergent(Leaf->getValue()) ||
             (I && isLeft(Loops.getLoopFor(I->getParent())));
    }
    if (const auto *Step = dyn_cast<SCEVAddRecExpr>(Part))
      return isLeft(Step->getLoop());
    return isa<SCEVCouldNotCompute>(Part);
  });
}

/// \p V as a number, addresses too.
const SCEV *numberOf(Value *V, ScalarEvolution &Evolution) {
  const SCEV *S = Evolution.getSCEV(V);
  return V->getType()->isPointerTy()
             ? Evolution.getPtrToIntExpr(
                   S, Evolution.getEffectiveSCEVType(V->getType()))
             : S;
}

} // namespace

bool vorion::markUniformTests(Function &F, FunctionAnalysisManager &Analyses) {
  if (!Enabled)
    return false;
  const auto &Uniform = Analyses.getResult<UniformityInfoAnalysis>(F);
  auto &Evolution = Analyses.getResult<ScalarEvolutionAnalysis>(F);
  const auto &Loops = Analyses.getResult<LoopAnalysis>(F);
  bool Changed = false;
  for (Instruction &I : instructions(F)) {
    auto *Test = dyn_cast<ICmpInst>(&I);
    if (!Test || !Test->isEquality() || !Uniform.isDivergent(Test) ||
        !Evolution.isSCEVable(Test->getOperand(0)->getType()))
      continue;
    const SCEV *Left = numberOf(Test->getOperand(0), Evolution);
    const SCEV *Right = numberOf(Test->getOperand(1), Evolution);
    if (isa<SCEVCouldNotCompute>(Left) || isa<SCEVCouldNotCompute>(Right) ||
        !agreeIn(Evolution.getMinusSCEV(Left, Right), Test->getParent(),
                 Uniform, Loops))
      continue;
    Test->setMetadata(uniformMarker(F.getContext()),
                      MDNode::get(F.getContext(), {}));
    remark<OptimizationRemark>(remarks::Uniform, "Test", *Test, [] {
      return "lanes differ in both sides of this comparison by the same "
             "distance, so all agree in it: no vx_split";
    });
    Changed = true;
  }
  return Changed;
}
