//===- FirstPasses.cpp - what the optimiser is told -----------------------===//

#include "ComponentStores.h"
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

/// \p Pass for modules of our machine, which only their functions tell.
template <typename Pass> class OnOurMachine : public Pass {
public:
  explicit OnOurMachine(const RISCVTargetMachine &TM) : TM(TM) {}
  PreservedAnalyses run(Module &M, ModuleAnalysisManager &Analyses) {
    if (any_of(M, [&](Function &F) {
          return !F.isDeclaration() &&
                 TM.getSubtarget<RISCVSubtarget>(F).hasVendorXVortex();
        }))
      return Pass::run(M, Analyses);
    return PreservedAnalyses::all();
  }

private:
  const RISCVTargetMachine &TM;
};

using ShareOurVariables = OnOurMachine<vorion::ShareVariables>;
using StoreOurComponents = OnOurMachine<vorion::StoreComponents>;

/// Lets -passes= name \p Pass.
template <typename Pass>
void nameModulePass(PassBuilder &PB, StringRef Wanted,
                    const RISCVTargetMachine &TM) {
  PB.registerPipelineParsingCallback(
      [&TM, Wanted](StringRef Name, ModulePassManager &Passes,
                    ArrayRef<PassBuilder::PipelineElement>) {
        if (Name != Wanted)
          return false;
        Passes.addPass(Pass(TM));
        return true;
      });
}

} // namespace

void vorion::registerFirstPasses(PassBuilder &PB,
                                 const RISCVTargetMachine &TM) {
  PB.registerPipelineStartEPCallback(
      [&TM](ModulePassManager &Passes, OptimizationLevel) {
        Passes.addPass(StoreOurComponents(TM));
        Passes.addPass(ShareOurVariables(TM));
      });
  registerKeptLines(PB);
  // Loops have their final form, and the unroller runs soon after.
  PB.registerVectorizerStartEPCallback(
      [](FunctionPassManager &Passes, OptimizationLevel) {
        Passes.addPass(UnrollPassLoops());
      });
  nameModulePass<ShareOurVariables>(PB, "vorion-share-variables", TM);
  nameModulePass<StoreOurComponents>(PB, "vorion-store-components", TM);
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
