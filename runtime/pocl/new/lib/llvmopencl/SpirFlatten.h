//===- SpirFlatten.h - one address space ----------------------------------===//

#ifndef POCL_SPIR_FLATTEN_H
#define POCL_SPIR_FLATTEN_H

#include "config.h"

#include <llvm/IR/Module.h>

#include <memory>

namespace pocl {

/// A copy of \p From in which every pointer is one of address space 0. The
/// device tells memories by their addresses, and its front end knows no other
/// address space either.
std::unique_ptr<llvm::Module> flattenAddressSpaces(const llvm::Module &From);

} // namespace pocl

#endif
