/// The random numbers of kernels/philox.h for the host, and their uses.
#pragma once

#include <cstdint>

namespace vorion::splat {

using uint = uint32_t;
using ulong = uint64_t;
#include "kernels/philox.h"

} // namespace vorion::splat
