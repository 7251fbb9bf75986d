/// What vorion-clang is told when it makes an image of OpenCL C.
#pragma once

#include "vorion/support/Expected.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vorion {

struct ClCommandLine {
  std::vector<std::filesystem::path> Inputs;
  /// Options for clBuildProgram, each followed by a blank.
  std::string BuildOptions;
  /// Lines of OpenCL C that stand before every input: macros and warnings,
  /// which PoCL's options take without quotes or not at all.
  std::string Prelude;
  std::filesystem::path Output;
};

/// Reads the arguments after the tool's name. An unknown option is a usage
/// error that names it.
Expected<ClCommandLine>
parseClCommandLine(const std::vector<std::string> &Arguments);

/// \p Folder as a -I option of clBuildProgram, with a blank after it; a name
/// with a double quote cannot be written.
Expected<std::string> includeOption(const std::string &Folder);

} // namespace vorion
