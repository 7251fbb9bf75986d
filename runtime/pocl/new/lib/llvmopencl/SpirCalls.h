//===- SpirCalls.h - calls of the built-in functions ----------------------===//

#ifndef POCL_SPIR_CALLS_H
#define POCL_SPIR_CALLS_H

#include "config.h"

#include <llvm/IR/Module.h>

#include <string>

namespace pocl {

/// Makes \p M, in one address space, call the functions of \p Library.
///
/// SPIR-V's reader names the built-in functions as OpenCL C does for SPIR:
/// _Z6vload4jPU3AS1Ki. The library has the names and the binary interface that
/// clang gives them for our target: _Z10_cl_vload4jPU8CLglobalKi, which returns
/// its vector through a pointer. They are the same function if they have the
/// same parameters, which the names say.
///
/// Functions that the library lacks are left alone: another module may have
/// them. Returns what is wrong, or nothing.
std::string callLibrary(llvm::Module &M, const llvm::Module &Library);

/// Names a function of \p M that is called with other types than it has, or
/// nothing. Where modules of SPIR-V and of OpenCL C are linked, a function with
/// vectors is another on either side.
std::string findMismatchedCall(const llvm::Module &M);

} // namespace pocl

#endif
