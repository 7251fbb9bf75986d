//===- RangeParts.h - launches that are parts of a range ------------------===//
//
// The last groups of a range may be smaller than the others. A device with
// lanes runs groups of one size in a launch, so such a range becomes several
// launches. Work-items ask for the whole range all the same: the launch block
// has it (docs/abi.md).
//
//===----------------------------------------------------------------------===//

#ifndef POCL_RANGE_PARTS_H
#define POCL_RANGE_PARTS_H

#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/Module.h>

#include <vector>

namespace pocl {

/// To the module of one kernel, before any other pass: makes the built-in
/// functions answer for the whole range.
void askForWholeRange(llvm::Module &M);

/// Pseudo variables that stand for words of the launch block. The Workgroup
/// pass replaces loads of them.
std::vector<llvm::GlobalVariable *> launchWords(llvm::Module &M);
bool isLaunchWord(const llvm::Value *Pointer);
llvm::Value *createLaunchWord(llvm::IRBuilder<> &Builder, llvm::Value *Launch,
                              const llvm::GlobalVariable &Word);

} // namespace pocl

#endif
