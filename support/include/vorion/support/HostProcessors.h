/// How many of the host's processors this process may use.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace vorion {

/// Those that it may run on (sched_setaffinity), but no more than its share of
/// time (\c shareOfTime), which is how containers limit it. More threads than
/// that would only stop each other. At least 1. What holds at the first call
/// is what all calls say.
unsigned hostProcessors();

/// How many processors' time control groups allow (Linux, cpu.max of version 2,
/// cpu.cfs_quota_us of version 1), rounded up; nothing where they set no limit.
/// \p Membership is what /proc/self/cgroup says, \p Root is /sys/fs/cgroup.
std::optional<unsigned> shareOfTime(std::string_view Membership,
                                    const std::filesystem::path &Root);

} // namespace vorion
