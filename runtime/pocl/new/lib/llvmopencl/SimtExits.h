//===- SimtExits.h - one return that every path of a kernel leads to ------===//

#ifndef POCL_SIMT_EXITS_H
#define POCL_SIMT_EXITS_H

#include "config.h"

#include <llvm/IR/PassManager.h>
#include <llvm/Passes/PassBuilder.h>

namespace pocl {

/// PoCL makes regions of what lies between two barriers, the return being one,
/// and a block that leads to neither would be in none. On a device with lanes
/// such a block, in an endless loop or before an `unreachable`, gets a way out
/// that is never taken. The optimiser cannot see that it is not.
class SimtExits : public llvm::PassInfoMixin<SimtExits> {
public:
  static void registerWithPB(llvm::PassBuilder &PB);
  llvm::PreservedAnalyses run(llvm::Function &F,
                              llvm::FunctionAnalysisManager &AM);
  static bool isRequired() { return true; }
};

} // namespace pocl

#endif
