/// What the host has to know of a program's kernels, kept beside the program in
/// PoCL's cache: otherwise LLVM would read all of the program for it.
#pragma once

#include "ProgramFields.h"
#include "vorion.h"

#include <string_view>

namespace vorion {

/// Fills in kernel_meta, num_kernels and global_var_total_size from \p Text, a
/// ProgramKernels (ProgramFields.h). False, and nothing filled in, if it is
/// none.
bool adoptKernels(cl_program Program, cl_uint Index, std::string_view Text);

/// The same from what was kept. False if nothing was.
bool takeKernels(cl_program Program, cl_uint Index);

/// Keeps them. That they cannot be kept is no problem.
void keepKernels(cl_program Program, cl_uint Index, std::string_view Text);

} // namespace vorion
