/// Number of processors of the host that this process may use.
#pragma once

#include <filesystem>
#include <optional>
#include <string_view>

namespace vorion {

/// The processors of the affinity mask (sched_setaffinity), limited by the CPU
/// quota of control groups (\c shareOfTime), which containers use. At least 1.
/// The value is determined at the first call.
unsigned hostProcessors();

/// CPU quota of control groups in processors (Linux, cpu.max of version 2,
/// cpu.cfs_quota_us of version 1), rounded up; empty without a limit. \p
/// Membership is the contents of /proc/self/cgroup, \p Root is /sys/fs/cgroup.
std::optional<unsigned> shareOfTime(std::string_view Membership,
                                    const std::filesystem::path &Root);

} // namespace vorion
