//===- ProgramVariables.h - variables of program scope --------------------===//
//
// All kernels of a program share its variables, but each is linked to an image
// of its own. So the variables lie in memory that the driver allocates, and the
// launch block says where (docs/abi.md, "Launch block and kernel table").
//
//===----------------------------------------------------------------------===//

#ifndef POCL_PROGRAM_VARIABLES_H
#define POCL_PROGRAM_VARIABLES_H

#include <llvm/IR/Module.h>

#include <string>

namespace pocl {

/// What the variables are at first: a constant with the fields of vx_variables
/// behind the first. Only kernels that use variables have it.
inline constexpr const char *VariablesRecord = "vorion_variables_record";

/// Gives each variable of \p M, a program before the built-in functions are
/// linked to it, a place in the memory that the pseudo variable
/// PoclGVarBufferName points to, and leaves what they are at first in
/// \c VariablesRecord. \p Bytes: of all. True, and \p Log says why, if the
/// program cannot have them.
bool placeProgramVariables(llvm::Module &M, size_t &Bytes, std::string &Log);

/// To the module of one kernel: forgets the variables if it uses none.
void dropUnusedVariables(llvm::Module &M);

} // namespace pocl

#endif
