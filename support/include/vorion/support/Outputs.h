/// Checks of a tool's output files before any work is done.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion {

/// A file and its name in messages: "-o", "the scene". An empty path means that
/// the file was not requested.
struct NamedFile {
  std::string Name;
  std::string Path;
};

/// Checks that each of \p Outputs can be written, and is not identical to
/// another output or to one of \p Inputs, including by symbolic or hard links.
/// Devices and pipes may be used more than once; standard output ("-") may not.
/// If it is used, printText() writes to standard error from then on.
Expected<Success> claimOutputs(const std::vector<NamedFile> &Outputs,
                               const std::vector<NamedFile> &Inputs = {});

} // namespace vorion
