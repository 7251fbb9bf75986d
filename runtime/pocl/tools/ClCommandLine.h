/// What vorion-clang is told when it makes an image of kernels.
#pragma once

#include "vorion/support/Expected.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace vorion {

struct ClCommandLine {
  std::vector<std::filesystem::path> Inputs;
  /// Options for clBuildProgram, each followed by a blank.
  std::string BuildOptions;
  /// Lines that stand before every input in OpenCL C: macros and warnings,
  /// which PoCL's options take without quotes or not at all.
  std::string Prelude;
  /// -Rpass..., -mllvm and -march for the machine's compiler, a word each.
  std::vector<std::string> ForMachine;
  /// Of ForMachine: what that compiler may not take.
  std::vector<std::string> ToCheck;
  std::filesystem::path Output;
  /// -v: the programs that are run are printed.
  bool Verbose = false;
  /// -save-temps: where each kernel's bitcode and object stay.
  std::optional<std::filesystem::path> Temporaries;
};

/// Reads the arguments after the tool's name. An unknown option is a usage
/// error that names it.
Expected<ClCommandLine>
parseClCommandLine(const std::vector<std::string> &Arguments);

/// Whether an input is a module of SPIR-V rather than OpenCL C.
bool isSpirv(const std::filesystem::path &Input);

/// \p Folder as a -I option of clBuildProgram, with a blank after it; a name
/// with a double quote cannot be written.
Expected<std::string> includeOption(const std::string &Folder);

} // namespace vorion
