/// PoCL's operations on buffers and images. Both live in the machine's global
/// memory, which the host sees as memory of its own: PoCL's common copying code
/// works on it, on the worker thread, never during a run.
#pragma once

#include "vorion.h"

namespace vorion {

void setMemoryOperations(pocl_device_ops *Ops);

} // namespace vorion
