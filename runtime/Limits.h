/// Limits of a launch that are the runtime's own.
#pragma once

#include <cstddef>
#include <cstdint>

namespace vorion::runtime {

/// Work-items of a group (docs/decisions.md, 6).
inline constexpr std::uint32_t MaxGroupItems = 1024;
/// Groups of a launch: the start-up code's group number plus the number of
/// cores must not wrap.
inline constexpr std::uint64_t MaxGroups = std::uint64_t{1} << 31;
/// OpenCL's least CL_DEVICE_PRINTF_BUFFER_SIZE of the full profile.
inline constexpr std::uint32_t PrintBytes = 1 << 20;
/// Console text of a run that is kept: a guest that writes forever must not
/// take the host's memory.
inline constexpr std::size_t ConsoleBytes = std::size_t{1} << 20;

} // namespace vorion::runtime
