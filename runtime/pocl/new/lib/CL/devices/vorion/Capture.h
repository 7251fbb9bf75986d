/// Launches kept for later: VORION_CAPTURE=FOLDER makes every kernel launch
/// leave what vorion-sim needs to repeat it.
#pragma once

#include "KernelCache.h"

namespace vorion {

/// Writes FOLDER/N-KERNEL.json (the request, for vorion-sim --args), .elf and
/// a file for each buffer, where N counts the process's launches; the request
/// names the buffers' files from the root, wherever FOLDER starts. Buffers that
/// arguments share become one each. Does nothing if VORION_CAPTURE is not set;
/// a file that cannot be written is warned of.
void captureLaunch(const LoadedKernel &Kernel, const _cl_command_node &Command);

} // namespace vorion
