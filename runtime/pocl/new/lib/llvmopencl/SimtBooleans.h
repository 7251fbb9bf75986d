//===- SimtBooleans.h - bools in memory that are neither 0 nor 1 ----------===//

#ifndef POCL_SIMT_BOOLEANS_H
#define POCL_SIMT_BOOLEANS_H

#include <llvm/IR/PassManager.h>

namespace pocl {

/// clang promises that the byte of a `bool` is 0 or 1. Host programs fill
/// buffers of them with other bytes, such as masks of 2 or 128. The code
/// generator then tests bit 0 in one place and the whole byte in another, and
/// lanes part where they were not split. This takes the promise back: any byte
/// but 0 is true. In the front end, before any other pass.
class SimtBooleans : public llvm::PassInfoMixin<SimtBooleans> {
public:
  llvm::PreservedAnalyses run(llvm::Function &F,
                              llvm::FunctionAnalysisManager &);
  static bool isRequired() { return true; }
};

} // namespace pocl

#endif
