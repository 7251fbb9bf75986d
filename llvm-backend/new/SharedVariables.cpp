#include "SharedVariables.h"
#include "llvm/IR/Module.h"
#include "llvm/Transforms/Utils/GlobalStatus.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"

using namespace llvm;

namespace {

/// Variables that others in the program can name are left alone as it is, and
/// one that nothing writes has one value for all.
bool isSharedVariable(const GlobalVariable &G) {
  if (!G.hasLocalLinkage() || !G.hasInitializer() || G.isConstant() ||
      G.isThreadLocal())
    return false;
  GlobalStatus Status;
  return GlobalStatus::analyzeGlobal(&G, Status) ||
         Status.StoredType != GlobalStatus::NotStored;
}

} // namespace

void vorion::shareVariables(Module &M) {
  SmallVector<GlobalValue *, 8> Shared;
  for (GlobalVariable &G : M.globals())
    if (isSharedVariable(G))
      Shared.push_back(&G);
  appendToCompilerUsed(M, Shared);
}

void vorion::forgetSharedVariables(Module &M) {
  removeFromUsedLists(M, [](Constant *Used) {
    const auto *G = dyn_cast<GlobalVariable>(Used);
    return G && G->hasLocalLinkage() && !G->isConstant();
  });
  // The list itself was a use, and outlives what it was the value of.
  for (GlobalVariable &G : M.globals())
    G.removeDeadConstantUsers();
}
