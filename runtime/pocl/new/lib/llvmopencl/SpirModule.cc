//===- SpirModule.cc - a module of SPIR-V becomes one of ours -------------===//

#include "SpirModule.h"
#include "CompilerWarnings.h"
IGNORE_COMPILER_WARNING("-Wmaybe-uninitialized")
#include "LLVMUtils.h"
#include "SpirCalls.h"
#include "SpirFlatten.h"
POP_COMPILER_DIAGS
IGNORE_COMPILER_WARNING("-Wunused-parameter")
#include <llvm/IR/InstrTypes.h>
#include <llvm/IR/Instructions.h>
#include <llvm/TargetParser/Triple.h>
POP_COMPILER_DIAGS

using namespace llvm;

namespace pocl {

namespace {

/// Local variables bear the name of a kernel, as clang gives it to them: that
/// is how isAutomaticLocal() knows them in one address space.
void nameLocalVariables(Module &M) {
  for (GlobalVariable &G : M.globals()) {
    if (G.getAddressSpace() != SPIR_ADDRESS_SPACE_LOCAL)
      continue;
    G.setLinkage(GlobalValue::InternalLinkage);
    G.setInitializer(UndefValue::get(G.getValueType()));
    for (Function &F : M)
      if (isKernelToProcess(F) && isGVarUsedByFunction(&G, &F)) {
        if (!G.getName().starts_with((F.getName() + ".").str()))
          G.setName(F.getName() + "." + G.getName());
        break;
      }
  }
}

/// Of what lies in constant memory, SPIR-V need not say that it is constant.
void keepConstants(Module &M) {
  for (GlobalVariable &G : M.globals())
    if (G.getAddressSpace() == SPIR_ADDRESS_SPACE_CONSTANT)
      G.setConstant(true);
}

/// A variable of program scope without a value of its own begins as zero.
void startVariables(Module &M) {
  for (GlobalVariable &G : M.globals())
    if (G.getAddressSpace() == SPIR_ADDRESS_SPACE_GLOBAL &&
        !G.hasInitializer() && !G.hasExternalLinkage())
      G.setInitializer(Constant::getNullValue(G.getValueType()));
}

void takeTarget(Module &M, const SpirTarget &Target) {
  M.setTargetTriple(Target.Library.getTargetTriple());
  M.setDataLayout(Target.Library.getDataLayout());
  SmallVector<Module::ModuleFlagEntry, 8> Flags;
  Target.Library.getModuleFlagsMetadata(Flags);
  for (const Module::ModuleFlagEntry &Flag : Flags)
    if (!M.getModuleFlag(Flag.Key->getString()))
      M.addModuleFlag(Flag.Behavior, Flag.Key->getString(), Flag.Val);
}

/// SPIR-V says of few functions that lanes must come to them together, and
/// knows nothing of a C library: printf is a name like others.
void takeConvention(Module &M, const SpirTarget &Target) {
  for (Function &F : M) {
    if (F.isIntrinsic())
      continue;
    if (F.getCallingConv() == CallingConv::SPIR_FUNC)
      F.setCallingConv(CallingConv::C);
    F.addFnAttr(Attribute::Convergent);
    if (F.isDeclaration())
      continue;
    F.addFnAttr("no-builtins");
    F.addFnAttr("target-cpu", Target.Cpu);
    F.addFnAttr("target-features", Target.Features);
    for (BasicBlock &Block : F)
      for (Instruction &I : Block) {
        auto *Call = dyn_cast<CallBase>(&I);
        if (!Call || isa<IntrinsicInst>(Call))
          continue;
        if (Call->getCallingConv() == CallingConv::SPIR_FUNC)
          Call->setCallingConv(CallingConv::C);
        Call->addFnAttr(Attribute::Convergent);
        Call->addFnAttr(Attribute::NoBuiltin);
      }
  }
}

} // namespace

std::string adoptSpirModule(std::unique_ptr<Module> &M,
                            const SpirTarget &Target) {
  const Triple From(M->getTargetTriple());
  if (!From.isSPIR())
    return {};
  if (From.isArch64Bit())
    return "the module is for addresses of 64 bits (" + From.str() +
           "), expected addresses of 32 bits (spir)\n";
  keepConstants(*M);
  startVariables(*M);
  nameLocalVariables(*M);
  M = flattenAddressSpaces(*M);
  takeTarget(*M, Target);
  takeConvention(*M, Target);
  return callLibrary(*M, Target.Library);
}

} // namespace pocl
