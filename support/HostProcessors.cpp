#include "vorion/support/HostProcessors.h"

#include "vorion/support/File.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>

namespace vorion {

namespace {

/// A limit in microseconds of a period. Version 2 has "QUOTA PERIOD" in one
/// file, where no quota is "max"; version 1 has two files, where it is -1.
std::optional<double> limitOf(const std::filesystem::path &Group,
                              bool IsVersion2) {
  double Quota = 0, Period = 0;
  if (IsVersion2) {
    std::ifstream(Group / "cpu.max") >> Quota >> Period;
  } else {
    std::ifstream(Group / "cpu.cfs_quota_us") >> Quota;
    std::ifstream(Group / "cpu.cfs_period_us") >> Period;
  }
  if (!(Quota > 0 && Period > 0))
    return std::nullopt;
  return Quota / Period;
}

bool has(const std::string &Controllers, const std::string &Name) {
  return ("," + Controllers + ",").find("," + Name + ",") != std::string::npos;
}

} // namespace

std::optional<unsigned> shareOfTime(std::string_view Membership,
                                    const std::filesystem::path &Root) {
  std::optional<double> Least;
  std::istringstream Lines{std::string(Membership)};
  std::string Id, Controllers, Place;
  while (std::getline(Lines, Id, ':') &&
         std::getline(Lines, Controllers, ':') && std::getline(Lines, Place)) {
    const bool IsVersion2 = Controllers.empty();
    if (!IsVersion2 && !has(Controllers, "cpu"))
      continue;
    const std::filesystem::path Top = Root / Controllers;
    // Each group above has a limit, too. In a container the place is often one
    // that only the host has: then the container's own group is the top.
    std::filesystem::path Group = std::filesystem::path(Place).relative_path();
    for (;; Group = Group.parent_path()) {
      if (const auto Limit = limitOf(Top / Group, IsVersion2))
        Least = std::min(*Limit, Least.value_or(*Limit));
      if (Group.empty())
        break;
    }
  }
  if (!Least)
    return std::nullopt;
  // No host has more processors than this.
  return static_cast<unsigned>(std::clamp(std::ceil(*Least), 1.0, 1e6));
}

unsigned hostProcessors() {
  // Asked once: each pool and each parallel loop wants to know.
  static const unsigned Found = [] {
    const unsigned MayRunOn = std::max(1U, std::thread::hardware_concurrency());
    const auto Membership = readFile("/proc/self/cgroup");
    if (!Membership)
      return MayRunOn;
    const std::string_view Text(
        reinterpret_cast<const char *>(Membership->data()), Membership->size());
    return std::min(MayRunOn,
                    shareOfTime(Text, "/sys/fs/cgroup").value_or(MayRunOn));
  }();
  return Found;
}

} // namespace vorion
