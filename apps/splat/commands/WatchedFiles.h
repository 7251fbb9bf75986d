/// The files of the environment's variables that watch runs
/// (docs/debugging.md).
#pragma once

#include "vorion/support/Outputs.h"

#include <vector>

namespace vorion::splat {

/// Whatever a variable may name: no output of splat may be one of them. For
/// claimOutputs(), among the inputs: the platform looks whether it can write
/// them.
std::vector<NamedFile> watchedFiles();

} // namespace vorion::splat
