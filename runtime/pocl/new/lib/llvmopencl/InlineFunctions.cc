//===- InlineFunctions.cc - functions that are declared inline ------------===//

#include "InlineFunctions.h"

#include <llvm/IR/Constants.h>
#include <llvm/IR/Module.h>

using namespace llvm;

void pocl::defineInlineFunctions(Module &M) {
  GlobalVariable *const Notes = M.getGlobalVariable("llvm.global.annotations");
  if (!Notes)
    return;
  // Of each note the first is what it is about, the second its text.
  for (const Use &Note : Notes->getInitializer()->operands()) {
    auto *F = dyn_cast<Function>(
        cast<Constant>(Note)->getOperand(0)->stripPointerCasts());
    const auto *Text = dyn_cast<GlobalVariable>(
        cast<Constant>(Note)->getOperand(1)->stripPointerCasts());
    const auto *Letters =
        Text ? dyn_cast<ConstantDataArray>(Text->getInitializer()) : nullptr;
    if (F && F->hasExternalLinkage() && Letters && Letters->isCString() &&
        Letters->getAsCString() == InlineNote)
      F->setLinkage(GlobalValue::WeakODRLinkage);
  }
  Notes->eraseFromParent();
}
