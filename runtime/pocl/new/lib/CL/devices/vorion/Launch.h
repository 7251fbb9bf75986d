/// Runs a kernel command.
#pragma once

#include "KernelCache.h"

namespace vorion {

/// Compiles the command's kernel if it is not, sets the event running, runs the
/// kernel to its end, prints what it printed, and keeps its counters with the
/// event. CL_SUCCESS, or the status that the event ends with,
/// after a report on standard error.
cl_int runKernel(vx_device *Device, KernelCache &Kernels,
                 _cl_command_node *Command);

} // namespace vorion
