/// From a kernel's bitcode to its image.
#pragma once

#include <string>
#include <vector>

namespace vorion {

struct MachineRequest {
  std::string Bitcode; ///< with the kernel's entry in the table of kernels
  bool Optimize = true;
  /// Further options of vorion-clang.
  std::vector<std::string> Options;
};

struct MachineAnswer {
  std::string Image; ///< an ELF file; empty if the kernel has an error
  std::string Object;
  std::string Problem; ///< why there is no image
};

/// Compiles and links as `vorion-clang` does, of which \p Bin is the folder.
/// What is printed on the way goes to standard error. A fatal error of LLVM or
/// lld ends the process.
MachineAnswer makeImage(const MachineRequest &Request, const std::string &Bin);

} // namespace vorion
