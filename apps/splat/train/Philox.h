/// The random numbers of kernels/philox.h for the host, and what they are for.
#pragma once

#include <cstdint>

namespace vorion::splat {

using uint = std::uint32_t;
using ulong = std::uint64_t;
#include "../kernels/philox.h"

} // namespace vorion::splat
