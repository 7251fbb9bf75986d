//===- FreezePoison.cpp - built-in functions without undefined results ----===//
//
// A plugin of the clang that compiles the built-in functions of OpenCL C.
//
// LLVM assumes that results which C leaves undefined (poison) are not used.
// Inside the library this does no harm: the machine wraps, saturates and shifts
// in its own way, and the functions choose another result at the end. But
// kernels inline the functions, and constants and known ranges of a kernel then
// show which results are poison: abs(INT_MIN), or the conversion to int within
// exp(NAN). So this pass removes the assumptions before any other pass sees
// them. It drops flags such as nsw, and freezes what is poison without flags:
// it becomes some value, the same for all its uses.
//
//===----------------------------------------------------------------------===//

#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/PassManager.h"
#include "llvm/Passes/PassBuilder.h"
#include "llvm/Passes/PassPlugin.h"
#include "llvm/Support/KnownBits.h"

using namespace llvm;

namespace {

/// Whether \p I, without its flags, can be poison where its operands are not.
bool canBePoison(const Instruction &I) {
  if (I.isShift()) {
    const KnownBits Amount =
        computeKnownBits(I.getOperand(1), I.getDataLayout());
    return Amount.getMaxValue().uge(Amount.getBitWidth());
  }
  return isa<ExtractElementInst, InsertElementInst>(I) &&
         canCreatePoison(cast<Operator>(&I),
                         /*ConsiderFlagsAndMetadata=*/false);
}

void freeze(Instruction &I) {
  IRBuilder<> Builder(I.getNextNode());
  Value *const Frozen = Builder.CreateFreeze(&I);
  I.replaceUsesWithIf(Frozen,
                      [&](const Use &Of) { return Of.getUser() != Frozen; });
}

/// A conversion to an integer of 8 or 16 bits becomes one to 32 bits first: the
/// code generator takes it for granted that the bits above are an extension.
void freezeConversion(CastInst &I) {
  Type *const To = I.getType();
  if (To->getScalarSizeInBits() >= 32) {
    freeze(I);
    return;
  }
  IRBuilder<> Builder(&I);
  Value *const Wide = Builder.CreateFPToSI(
      I.getOperand(0), To->getWithNewType(Builder.getInt32Ty()));
  I.replaceAllUsesWith(Builder.CreateTrunc(Builder.CreateFreeze(Wide), To));
  I.eraseFromParent();
}

class FreezePoison : public PassInfoMixin<FreezePoison> {
public:
  PreservedAnalyses run(Function &F, FunctionAnalysisManager & /*Manager*/) {
    for (Instruction &I : make_early_inc_range(instructions(F))) {
      // Pointers stay within their objects.
      if (!isa<GetElementPtrInst>(I))
        I.dropPoisonGeneratingAnnotations();
      if (auto *Call = dyn_cast<IntrinsicInst>(&I);
          Call &&
          is_contained({Intrinsic::abs, Intrinsic::ctlz, Intrinsic::cttz},
                       Call->getIntrinsicID()))
        Call->setArgOperand(1, ConstantInt::getFalse(I.getContext()));
      if (isa<FPToSIInst, FPToUIInst>(I))
        freezeConversion(cast<CastInst>(I));
      else if (canBePoison(I))
        freeze(I);
    }
    return PreservedAnalyses::none();
  }
  /// Also where functions are not optimised.
  static bool isRequired() { return true; }
};

} // namespace

extern "C" LLVM_ATTRIBUTE_VISIBILITY_DEFAULT PassPluginLibraryInfo
llvmGetPassPluginInfo() {
  return {
      LLVM_PLUGIN_API_VERSION, "FreezePoison", "1", [](PassBuilder &Builder) {
        Builder.registerPipelineStartEPCallback(
            [](ModulePassManager &Passes, OptimizationLevel /*Level*/) {
              Passes.addPass(createModuleToFunctionPassAdaptor(FreezePoison()));
            });
      }};
}
