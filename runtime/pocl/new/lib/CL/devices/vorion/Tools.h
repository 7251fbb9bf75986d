/// The compiler and linker of device code, run in processes beside this one:
/// LLVM's command line options are registered once a process, and ours differ
/// from PoCL's LLVM.
#pragma once

#include <string>
#include <vector>

namespace vorion {

class Tools {
public:
  /// Looks for bin/vorion-clang below VORION_ROOT, else below the folders above
  /// this library.
  Tools();

  /// Empty if the tools were found, else what is missing.
  const std::string &problem() const { return Problem; }

  /// Headers for kernels.
  std::string includeFolder() const { return Root + "/include/vorion"; }

  /// Changes whenever this library, the compiler's, a tool or the device
  /// library does. Part of the key of cached binaries.
  std::string fingerprint() const;

  /// Bitcode to a relocatable object; unless \p Optimize, with variables where
  /// debuggers find them. Empty on success, else the tool's output.
  std::string compile(const std::string &Bitcode, const std::string &Object,
                      bool Optimize) const;

  /// An object to an image that can be loaded.
  std::string link(const std::string &Object, const std::string &Image) const;

private:
  std::string run(std::vector<std::string> Arguments) const;
  std::string Root, Problem;
};

} // namespace vorion
