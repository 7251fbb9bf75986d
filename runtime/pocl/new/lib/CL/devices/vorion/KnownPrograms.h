/// Programs that were built from the same text before. PoCL names a program in
/// the kernel cache by its preprocessed text, and so needs clang to find it. To
/// start clang takes longer than most small kernels. A text that includes no
/// files but ours always gives the same program, and the kernel cache keeps
/// which.
#pragma once

#include "Tools.h"
#include "vorion.h"

namespace vorion {

/// Finds a program of source that was built with its present options. Then it
/// is as pocl_driver_build_source() leaves it, except that llvm_irs is null.
bool takeKnownProgram(cl_program Program, cl_uint Index, const Tools &ToolSet);

/// To be called when the program was built. Keeps which one it is, if its text
/// says so for good. That it cannot be kept is no problem.
void keepKnownProgram(cl_program Program, cl_uint Index, const Tools &ToolSet);

} // namespace vorion
