/// The last steps on a kernel's bitcode that need LLVM: the kernel's entry in
/// the table vorion_kernels (docs/abi.md), and addresses of static local
/// memory.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace vorion {

struct KernelArgument {
  std::string Name;
  uint32_t Kind = 0; ///< VX_ARG_*
};
template <typename Archive> void visit(Archive &A, KernelArgument &Argument) {
  A.text(Argument.Name);
  A.number(Argument.Kind);
}

struct KernelDescription {
  std::string Name;
  std::vector<KernelArgument> Arguments;
  uint32_t LocalSize[3] = {}; ///< compiled for, 0 for any
  uint32_t MaxItems = 0;      ///< of a group that it can be launched with
};
template <typename Archive> void visit(Archive &A, KernelDescription &Kernel) {
  A.text(Kernel.Name);
  A.list(Kernel.Arguments);
  for (uint32_t &Size : Kernel.LocalSize)
    A.number(Size);
  A.number(Kernel.MaxItems);
}

/// Finishes \p Module (an llvm::Module that PoCL's work-group passes made of
/// the kernel) and gives its bitcode. Empty on success, else what is wrong.
std::string finishKernelModule(void *Module, const KernelDescription &Kernel,
                               std::string &Bitcode);

} // namespace vorion
