/// From a kernel's bitcode to its image.
#pragma once

#include <string>
#include <vector>

namespace vorion {

/// What is linked.
struct NamedObject {
  std::string Name; ///< in messages, such as "kernel f"
  std::string Bytes;
};
template <typename Archive> void visit(Archive &A, NamedObject &Object) {
  A.text(Object.Name);
  A.text(Object.Bytes);
}

struct MachineRequest {
  std::string Name;    ///< of the object that is made
  std::string Bitcode; ///< with the kernel's entry in the table of kernels
  bool Optimize = true;
  /// Further options of vorion-clang.
  std::vector<std::string> Options;
  bool WantsImage = true; ///< or the object alone
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

/// Links \p Objects as `vorion-link` does.
MachineAnswer linkObjects(const std::vector<NamedObject> &Objects);

/// Whether `vorion-clang` takes \p Options. Prints why not, or ends the process
/// with it.
bool areOptions(const std::vector<std::string> &Options,
                const std::string &Bin);

} // namespace vorion
