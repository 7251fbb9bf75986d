#include "FolderTest.h"
#include "vorion/support/File.h"
#include "vorion/support/HostProcessors.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <sched.h>

using namespace vorion;

namespace {

class HostProcessorsTest : public FolderTest {
protected:
  void write(const std::string &File, const std::string &Text) {
    std::filesystem::create_directories(
        std::filesystem::path(path(File)).parent_path());
    ASSERT_TRUE(writeFileAtomically(path(File), Text));
  }
  std::optional<unsigned> share(const char *Membership) {
    return shareOfTime(Membership, path("."));
  }
};

TEST_F(HostProcessorsTest, WithoutAQuotaThereIsNoLimit) {
  write("cpu.max", "max 100000\n");
  write("cpu/cpu.cfs_quota_us", "-1\n");
  write("cpu/cpu.cfs_period_us", "100000\n");
  EXPECT_EQ(share("1:cpu:/\n0::/\n"), std::nullopt);
  EXPECT_EQ(share(""), std::nullopt);
  EXPECT_EQ(share("no groups"), std::nullopt);
  EXPECT_EQ(share("0::/gone/and gone\n"), std::nullopt);
}

TEST_F(HostProcessorsTest, PartsOfAProcessorAreRoundedUp) {
  write("cpu.max", "250000 100000\n");
  EXPECT_EQ(share("0::/\n"), 3U);
  write("cpu.max", "5000 100000\n");
  EXPECT_EQ(share("0::/\n"), 1U);
}

TEST_F(HostProcessorsTest, TheSmallestLimitOfAllGroupsAboveDecides) {
  write("a/cpu.max", "200000 100000\n");
  write("a/b/cpu.max", "400000 100000\n");
  write("a/b/c/cpu.max", "max 100000\n");
  EXPECT_EQ(share("0::/a/b/c\n"), 2U);
  EXPECT_EQ(share("0::/a/b/c/only the host has this\n"), 2U);
}

TEST_F(HostProcessorsTest, Version1HasAFolderAController) {
  write("cpu,cpuacct/job/cpu.cfs_quota_us", "150000\n");
  write("cpu,cpuacct/job/cpu.cfs_period_us", "50000\n");
  write("cpuset/job/cpu.cfs_quota_us", "1\n"); // of no use there
  write("cpuset/job/cpu.cfs_period_us", "1\n");
  EXPECT_EQ(
      share("9:name=systemd:/\n3:cpuset:/job\n2:cpu,cpuacct:/job\n0::/\n"), 3U);
}

TEST(HostProcessors, AreNoMoreThanThisProcessMayRunOn) {
  cpu_set_t Set;
  ASSERT_EQ(sched_getaffinity(0, sizeof Set, &Set), 0);
  EXPECT_GE(hostProcessors(), 1U);
  EXPECT_LE(hostProcessors(), static_cast<unsigned>(CPU_COUNT(&Set)));
}

} // namespace
