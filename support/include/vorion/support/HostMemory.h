/// Main memory of the host.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace vorion {

/// In bytes, without limits of control groups.
uint64_t hostMemory();

/// Gives back the pages that lie wholly in \p Done, memory of this process that
/// it has written and does not read again. The memory stays the caller's.
void releasePages(std::span<const std::byte> Done);

} // namespace vorion
