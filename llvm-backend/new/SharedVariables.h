//===- SharedVariables.h - variables that all lanes share -------*- C++ -*-===//
//
// Shared with PoCL, which optimises a kernel before it is given to
// vorion-clang.
//
//===----------------------------------------------------------------------===//

#ifndef VORION_LLVM_BACKEND_SHAREDVARIABLES_H
#define VORION_LLVM_BACKEND_SHAREDVARIABLES_H

#include "llvm/IR/PassManager.h"

namespace llvm {
namespace vorion {

/// Says that \p M's static variables, OpenCL's local ones among them, are
/// referred to from where the optimiser cannot see (llvm.compiler.used). A
/// function runs on all lanes at once, and one lane reads what another wrote.
/// LLVM takes a function's run for the only one: a variable that every run
/// writes before it reads becomes a variable of the run (GlobalOpt).
/// Before any other pass.
void shareVariables(Module &M);

/// shareVariables as a pass.
class ShareVariables : public PassInfoMixin<ShareVariables> {
public:
  PreservedAnalyses run(Module &M, ModuleAnalysisManager &) {
    shareVariables(M);
    return PreservedAnalyses::all();
  }
  static bool isRequired() { return true; }
};

/// Takes back what shareVariables said, once every variable has its address:
/// one that nothing uses any more then has no use.
void forgetSharedVariables(Module &M);

} // namespace vorion
} // namespace llvm

#endif
