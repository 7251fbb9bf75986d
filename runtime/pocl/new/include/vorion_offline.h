/// What vorion-clang asks the library for: kernels that are compiled without a
/// program of OpenCL, by the same requests to the compiler as those of
/// programs.
#pragma once

#include <string>
#include <vector>

namespace vorion {

struct OfflineProgram {
  std::string Text; ///< OpenCL C, or a module of SPIR-V
  bool IsSpirv = false;
  std::string Options; ///< as of clBuildProgram()
  bool WantsBitcode = false;
};

struct OfflineKernel {
  std::string Name, Object;
  std::string Bitcode; ///< if it is wanted
};

struct OfflineAnswer {
  bool IsBuilt = false; ///< whether the program has no error
  bool IsWhole = false; ///< whether each of its kernels was compiled
  std::vector<OfflineKernel> Kernels;
  std::string Log; ///< what the front end says of the program
  /// What else was printed, and why something failed: lines of the platform,
  /// each after "vorion: error: ", and of the compiler.
  std::string Printed;
};

class OfflineCompiler {
public:
  virtual ~OfflineCompiler() = default;

  /// The command line of the compiler's process.
  virtual std::string commandLine() const = 0;

  /// Compiles each kernel for its required group size, or for any.
  virtual OfflineAnswer compile(const OfflineProgram &Program) = 0;

  /// The image of \p Kernels, which messages call by their names; empty, and
  /// \p Printed why, if they cannot be linked.
  virtual std::string link(const std::vector<OfflineKernel> &Kernels,
                           std::string &Printed) = 0;

  /// Whether the machine's compiler takes the options of VORION_REMARKS.
  virtual bool areOptions(std::string &Printed) = 0;
};

/// The name of the function of the library that gives it, of the type below. It
/// is called once, in a process that is no program of OpenCL.
inline constexpr const char *OfflineCompilerFunction =
    "vorion_offline_compiler";
using OfflineCompilerOf = OfflineCompiler *();

} // namespace vorion
