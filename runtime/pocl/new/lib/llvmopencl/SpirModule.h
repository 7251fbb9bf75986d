//===- SpirModule.h - a module of SPIR-V becomes one of ours --------------===//

#ifndef POCL_SPIR_MODULE_H
#define POCL_SPIR_MODULE_H

#include "config.h"

#include <llvm/IR/Module.h>

#include <memory>
#include <string>

namespace pocl {

/// What a program for SPIR (triple spir) is told of the device.
struct SpirTarget {
  /// The built-in functions, whose triple, layout and flags become the
  /// module's.
  const llvm::Module &Library;
  std::string Cpu, Features;
};

/// Makes of \p M what our front end makes of OpenCL C: one address space, our
/// calling convention, and calls of \p Target's built-in functions. A module
/// that is not for SPIR stays as it is. Returns what is wrong, or nothing.
std::string adoptSpirModule(std::unique_ptr<llvm::Module> &M,
                            const SpirTarget &Target);

} // namespace pocl

#endif
