//===- ComponentStores.h - stores of vectors' components -------*- C++ -*-===//
//
// Shared with PoCL, as SharedVariables.h is.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_COMPONENTSTORES_H
#define VORION_LLVM_BACKEND_COMPONENTSTORES_H

#include "llvm/IR/PassManager.h"

namespace llvm {
namespace vorion {

/// Stores those components of vectors in memory that a program assigns, and no
/// others. For `o[v].x = g` clang loads a whole vector, changes a component and
/// stores the whole: what another lane or core has written to the others in the
/// meantime is lost. Variables of the function itself are left alone. Before
/// any other pass, which might move the load or the store.
void storeComponents(Module &M);

/// storeComponents as a pass.
class StoreComponents : public PassInfoMixin<StoreComponents> {
public:
  PreservedAnalyses run(Module &M, ModuleAnalysisManager &) {
    storeComponents(M);
    return PreservedAnalyses::none();
  }
  static bool isRequired() { return true; }
};

} // namespace vorion
} // namespace llvm

#endif
