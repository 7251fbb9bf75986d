//===- Steps.cpp - our steps over IR as passes with names -----------------===//
//
// `vorion-opt -passes=vorion-select-sides` and the like run one step of
// divergence lowering alone, which is how each has tests of its own.
// Compilation itself runs LowerDivergence.cpp as a whole.
//
//===----------------------------------------------------------------------===//

#include "LowerDivergence.h"
#include "RISCVSubtarget.h"
#include "RISCVTargetMachine.h"
#include "UnifyExits.h"
#include "Vorion.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/PostDominators.h"
#include "llvm/Passes/PassBuilder.h"
#include "llvm/Transforms/Utils/LCSSA.h"
#include "llvm/Transforms/Utils/LoopSimplify.h"

using namespace llvm;

namespace {

/// A step, on functions of our machine.
using Step = bool (*)(Function &, FunctionAnalysisManager &,
                      const RISCVSubtarget &);

class StepPass : public PassInfoMixin<StepPass> {
public:
  StepPass(Step Run, const RISCVTargetMachine &TM) : Run(Run), TM(TM) {}
  PreservedAnalyses run(Function &F, FunctionAnalysisManager &Analyses) {
    const auto &Subtarget = TM.getSubtarget<RISCVSubtarget>(F);
    return Subtarget.hasVendorXVortex() && Run(F, Analyses, Subtarget)
               ? PreservedAnalyses::none()
               : PreservedAnalyses::all();
  }
  /// Functions that are not optimised are lowered, too.
  static bool isRequired() { return true; }

private:
  Step Run;
  const RISCVTargetMachine &TM;
};

/// Runs \p Mark, which needs to know where lanes meet.
template <auto Mark>
bool markIn(Function &F, FunctionAnalysisManager &Analyses,
            const RISCVSubtarget &) {
  return Mark(F, Analyses.getResult<UniformityInfoAnalysis>(F),
              Analyses.getResult<PostDominatorTreeAnalysis>(F));
}

constexpr std::pair<StringLiteral, Step> Steps[] = {
    {"vorion-unify-exits",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       return vorion::unifyExits(
           F, Analyses.getResult<LoopAnalysis>(F), /*Known=*/true,
           [](IRBuilder<> &Builder) { return Builder.getTrue(); });
     }},
    {"vorion-atomic-places",
     [](Function &F, FunctionAnalysisManager &, const RISCVSubtarget &) {
       return vorion::markAtomicPlaces(F);
     }},
    {"vorion-uniform-tests",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       return vorion::markUniformTests(F, Analyses);
     }},
    {"vorion-raise-invariants",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       return vorion::raiseInvariants(F, Analyses);
     }},
    {"vorion-select-sides", vorion::selectShortSides},
    {"vorion-divergent-joins", markIn<vorion::markDivergentJoins>},
    {"vorion-merge-loop-exits",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       return vorion::mergeLoopExits(F, Analyses);
     }},
    {"vorion-reconverge",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       return vorion::reconvergeEarly(F, Analyses);
     }},
    {"vorion-repeated-blocks", markIn<vorion::markRepeatedBlocks>},
    {"vorion-insert-splits",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &) {
       vorion::insertSplits(F, Analyses);
       return true;
     }},
    {"vorion-lower-divergence",
     [](Function &F, FunctionAnalysisManager &Analyses,
        const RISCVSubtarget &Subtarget) {
       vorion::lowerDivergence(F, Analyses, Subtarget, /*Optimize=*/true);
       return true;
     }},
};

} // namespace

void vorion::registerSteps(PassBuilder &PB, const RISCVTargetMachine &TM) {
  PB.registerPipelineParsingCallback(
      [&TM](StringRef Name, FunctionPassManager &Passes,
            ArrayRef<PassBuilder::PipelineElement>) {
        const auto *Found = find_if(
            Steps, [&](const auto &Named) { return Named.first == Name; });
        if (Found == std::end(Steps))
          return false;
        // Loops in the form that the lowering has them in.
        if (Name == "vorion-merge-loop-exits") {
          Passes.addPass(LoopSimplifyPass());
          Passes.addPass(LCSSAPass());
        }
        Passes.addPass(StepPass(Found->second, TM));
        return true;
      });
}
