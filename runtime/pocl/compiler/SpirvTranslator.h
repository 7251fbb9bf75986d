/// Modules of SPIR-V as bitcode.
#pragma once

#include "ProgramServer.h"

namespace vorion {

/// Runs the translator of LLVM and SPIR-V (VORION_LLVM_SPIRV), which reads and
/// writes files in memory. The result has what it printed, and how it failed.
Translation translateSpirv(const std::string &Module);

} // namespace vorion
