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

/// Whether \p M is for our machine, which only its functions tell. PoCL's
/// passes compile for plain RISC-V, in vorion-compiler too.
bool isOurs(const Module &M, const RISCVTargetMachine &TM) {
  return any_of(M, [&](const Function &F) {
    return !F.isDeclaration() &&
           TM.getSubtarget<RISCVSubtarget>(F).hasVendorXVortex();
  });
}

/// \p Pass for modules of our machine.
template <typename Pass> class OnOurMachine : public Pass {
public:
  explicit OnOurMachine(const RISCVTargetMachine &TM) : TM(TM) {}
  PreservedAnalyses run(Module &M, ModuleAnalysisManager &Analyses) {
    if (isOurs(M, TM))
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
  registerKeptLines(PB, [&TM](const Module &M) { return isOurs(M, TM); });
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
