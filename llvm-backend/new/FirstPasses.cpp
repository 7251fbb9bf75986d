//===- FirstPasses.cpp - what the optimiser is told -----------------------===//

#include "KeptLines.h"
#include "PassLoops.h"
#include "RISCVSubtarget.h"
#include "RISCVTargetMachine.h"
#include "SharedVariables.h"
#include "Vorion.h"
#include "llvm/IR/Module.h"
#include "llvm/Passes/PassBuilder.h"

using namespace llvm;

namespace {

/// vorion::ShareVariables for modules of our machine, which only their
/// functions tell.
class ShareOurVariables : public vorion::ShareVariables {
public:
  explicit ShareOurVariables(const RISCVTargetMachine &TM) : TM(TM) {}
  PreservedAnalyses run(Module &M, ModuleAnalysisManager &Analyses) {
    if (any_of(M, [&](Function &F) {
          return !F.isDeclaration() &&
                 TM.getSubtarget<RISCVSubtarget>(F).hasVendorXVortex();
        }))
      return ShareVariables::run(M, Analyses);
    return PreservedAnalyses::all();
  }

private:
  const RISCVTargetMachine &TM;
};

} // namespace

void vorion::registerFirstPasses(PassBuilder &PB,
                                 const RISCVTargetMachine &TM) {
  PB.registerPipelineStartEPCallback(
      [&TM](ModulePassManager &Passes, OptimizationLevel) {
        Passes.addPass(ShareOurVariables(TM));
      });
  registerKeptLines(PB);
  // Loops have their final form, and the unroller runs soon after.
  PB.registerVectorizerStartEPCallback(
      [](FunctionPassManager &Passes, OptimizationLevel) {
        Passes.addPass(UnrollPassLoops());
      });
  PB.registerPipelineParsingCallback(
      [&TM](StringRef Name, ModulePassManager &Passes,
            ArrayRef<PassBuilder::PipelineElement>) {
        if (Name != "vorion-share-variables")
          return false;
        Passes.addPass(ShareOurVariables(TM));
        return true;
      });
  PB.registerPipelineParsingCallback(
      [](StringRef Name, FunctionPassManager &Passes,
         ArrayRef<PassBuilder::PipelineElement>) {
        if (Name != "vorion-unroll-passes")
          return false;
        Passes.addPass(UnrollPassLoops());
        return true;
      });
  registerSteps(PB, TM);
}
