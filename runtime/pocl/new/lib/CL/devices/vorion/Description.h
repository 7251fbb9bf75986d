/// What the device says of itself, and how PoCL compiles for it.
#pragma once

#include "vorion.h"

#include <vorion/runtime.h>

#include <cstdint>

namespace vorion {

/// The bytes of global memory that programs cannot allocate: launches need
/// some, most of all kernels that keep arrays across barriers.
uint64_t keptForLaunches(const vx_device_info &Info);

void describeDevice(cl_device_id Device, const vx_device_info &Info);

/// How PoCL compiles for the device.
void describeCompilation(cl_device_id Device, const vx_device_info &Info);

} // namespace vorion
