/// What the host has to know of a program's kernels, kept beside the program in
/// PoCL's cache: otherwise LLVM would read all of the program for it.
#pragma once

#include "ProgramFields.h"
#include "vorion.h"

namespace vorion {

/// Gives \p Program the kernels, whose memory becomes the program's.
void adoptKernels(cl_program Program, cl_uint Index,
                  const ProgramKernels &Known);

/// Fills in kernel_meta, num_kernels and global_var_total_size as they were
/// kept. False, and nothing filled in, if nothing was.
bool takeKernels(cl_program Program, cl_uint Index);

/// Keeps them. That they cannot be kept is no problem.
void keepKernels(cl_program Program, cl_uint Index);

} // namespace vorion
