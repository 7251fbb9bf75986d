/// What happens when the compiler needs more memory than there is.
#pragma once

namespace vorion {

/// From now on, when memory runs out inside LLVM, which cannot go on then, the
/// process ends with one line and exit code 5 instead of a signal.
void endInOneLineWithoutMemory();

} // namespace vorion
