/// What a tool writes, looked at before any work is done for it.
#pragma once

#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion {

/// A file and what it is called in messages: "-o", "the scene". An empty path
/// is a file that nobody asked for.
struct NamedFile {
  std::string Name;
  std::string Path;
};

/// Whether each of \p Outputs could be written, and is neither another of them
/// nor one of \p Inputs, under whatever name: by another spelling, a symbolic
/// or a hard link. Devices and pipes may be named more than once; standard
/// output ("-") may not. If that is one of them, nothing but it shall get
/// there: printText() writes to standard error from then on.
Expected<Success> claimOutputs(const std::vector<NamedFile> &Outputs,
                               const std::vector<NamedFile> &Inputs = {});

} // namespace vorion
