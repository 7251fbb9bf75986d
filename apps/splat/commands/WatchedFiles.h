/// The files of observers that environment variables request
/// (docs/debugging.md).
#pragma once

#include "vorion/support/Outputs.h"

#include <vector>

namespace vorion::splat {

/// All files that variables name, to be passed to claimOutputs() as inputs, so
/// that no output of splat is one of them. The platform checks whether they are
/// writable.
std::vector<NamedFile> watchedFiles();

} // namespace vorion::splat
