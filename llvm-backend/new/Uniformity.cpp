//===- Uniformity.cpp - which values lanes may disagree in ----------------===//
//
// What LLVM's uniformity analysis asks of a target. It follows operands and
// control flow itself; here are only the values that differ, or do not, for
// reasons of their own.
//
//===----------------------------------------------------------------------===//

#include "Intrinsics.h"
#include "Vorion.h"
#include "llvm/ADT/SetVector.h"
#include "llvm/IR/Instructions.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/Operator.h"

using namespace llvm;

namespace {

/// A work-group function: every lane is called with the same arguments
/// (docs/abi.md, "Launch block and kernel table"). PoCL names them.
bool isKernel(const Function &F) {
  return F.hasFnAttribute("vorion-kernel") ||
         (F.getName().starts_with("_pocl_kernel_") &&
          F.getName().ends_with("_workgroup"));
}

/// Whether \p V may hold bits that nothing defines. Lanes then hold different
/// ones, whatever the analysis says of a value that has one defined operand.
bool mayBeUndefined(const Value *V) {
  constexpr unsigned MaxValues = 256;
  SmallSetVector<const Value *, 16> Found;
  Found.insert(V);
  for (unsigned I = 0; I < Found.size(); ++I) {
    if (isa<UndefValue>(Found[I]) || Found.size() > MaxValues)
      return true;
    const auto *From = dyn_cast<Instruction>(Found[I]);
    if (!From || isa<LoadInst>(From) ||
        (isa<CallBase>(From) && !isa<IntrinsicInst>(From)))
      continue;
    for (const Use &Operand : From->operands())
      if (!isa<BasicBlock>(Operand))
        Found.insert(Operand);
  }
  return false;
}

bool isCallSource(const CallBase &Call) {
  if (const auto *I = dyn_cast<IntrinsicInst>(&Call)) {
    switch (I->getIntrinsicID()) {
    // Addresses in the lane's own stack.
    case Intrinsic::frameaddress:
    case Intrinsic::addressofreturnaddress:
    case Intrinsic::stacksave:
    case Intrinsic::threadlocal_address:
      return true;
    default:
      return false;
    }
  }
  // A function of its arguments alone gives equal results for equal arguments.
  return Call.isInlineAsm() || !Call.doesNotAccessMemory() ||
         Call.isConvergent();
}

} // namespace

bool vorion::isSourceOfDivergence(const Value *V) {
  if (const auto *A = dyn_cast<Argument>(V))
    return !isKernel(*A->getParent());
  const auto *I = dyn_cast<Instruction>(V);
  if (!I)
    return false;
  if (I->hasMetadata(vorion::divergentMarker(I->getContext())))
    return true;
  if (const vorion::IntrinsicRecord *Ours = vorion::findIntrinsic(V))
    return Ours->Result == vorion::Divergence::Source;
  if (const auto *Call = dyn_cast<CallBase>(I))
    return isCallSource(*Call);
  // Every lane has its own stack; atomics run lane by lane; between two lanes'
  // volatile or atomic loads another may have stored.
  return isa<AllocaInst, AtomicRMWInst, AtomicCmpXchgInst>(I) ||
         (isa<LoadInst>(I) && (I->isVolatile() || I->isAtomic())) ||
         (isa<FreezeInst>(I) && mayBeUndefined(I->getOperand(0)));
}

bool vorion::isAlwaysUniform(const Value *V) {
  const auto *I = dyn_cast<Instruction>(V);
  if (!I || I->hasMetadata(vorion::divergentMarker(I->getContext())))
    return false;
  if (I->hasMetadata(vorion::uniformMarker(I->getContext())))
    return true;
  const vorion::IntrinsicRecord *Ours = vorion::findIntrinsic(V);
  return Ours && Ours->Result == vorion::Divergence::Uniform;
}

void vorion::preferModuleTarget(const std::string &ModuleCPU,
                                const std::string &ModuleFeatures,
                                std::string &CPU, std::string &TuneCPU,
                                std::string &Features) {
  if (ModuleCPU != "vorion" && !StringRef(ModuleFeatures).contains("+xvortex"))
    return;
  CPU = TuneCPU = ModuleCPU;
  Features = ModuleFeatures;
}
