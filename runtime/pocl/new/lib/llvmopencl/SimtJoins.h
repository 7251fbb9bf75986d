//===- SimtJoins.h - regions that meet behind a conditional barrier -------===//

#ifndef POCL_SIMT_JOINS_H
#define POCL_SIMT_JOINS_H

#include "config.h"

#include <llvm/IR/PassManager.h>
#include <llvm/Passes/PassBuilder.h>

namespace pocl {

/// Where ways meet that come from different barriers, a region would have two
/// entries. PoCL copies everything behind such a place for each way, which
/// doubles the kernel at every conditional barrier. On a device with lanes each
/// way gets a barrier at its end instead, and a region begins where they meet.
/// All work-items of a group pass it, since all or none took the way with the
/// barrier. A block that only some of a way's work-items pass, on the way to
/// such a place, is copied for each way.
class SimtJoins : public llvm::PassInfoMixin<SimtJoins> {
public:
  static void registerWithPB(llvm::PassBuilder &PB);
  llvm::PreservedAnalyses run(llvm::Function &F,
                              llvm::FunctionAnalysisManager &AM);
  static bool isRequired() { return true; }
};

} // namespace pocl

#endif
