/// Main memory of the host.
#pragma once

#include <cstdint>

namespace vorion {

/// In bytes, without limits of control groups.
uint64_t hostMemory();

} // namespace vorion
