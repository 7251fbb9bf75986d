/// What PoCL's library asks of LLVM, which vorion-compiler does
/// (Tools.h). pocl_llvm.h declares most of it: those functions are
/// defined here.
#pragma once

#include "CompilerMessages.h"
#include "vorion.h"

namespace vorion {

/// A request for \p Task on device \p Index of \p Program. It contains the
/// program's binary for the device if there is one.
CompilerRequest requestFor(cl_program Program, cl_uint Index,
                           CompilerTask Task);

/// Gives \p Program the description of its kernels. False if there is none.
bool describeKernels(cl_program Program, cl_uint Index);

} // namespace vorion
