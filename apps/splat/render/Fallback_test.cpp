#include "render/Fallback.h"

#include "device/BuildRecord.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vorion::splat {
namespace {

TEST(Fallback, OnlyToFlagsThatAreBuiltAndCostLessThanBuilding) {
  EXPECT_TRUE(paysToFallBack(600, 1, true));
  EXPECT_TRUE(paysToFallBack(1000000, 1, true));
  // Nothing to build, or as much either way.
  EXPECT_FALSE(paysToFallBack(600, 0, true));
  EXPECT_FALSE(paysToFallBack(600, 1, false));
  // So many Gaussians that one frame's tests of flags take longer.
  EXPECT_FALSE(paysToFallBack(20000000, 1, true));
  EXPECT_TRUE(paysToFallBack(20000000, 4, true));
}

TEST(BuildRecord, KnowsWhatWasAddedToItsFolder) {
  const std::string Folder =
      testing::TempDir() + "build-record" + std::to_string(getpid());
  const BuildRecord Record(Folder);
  EXPECT_FALSE(Record.has("a"));
  Record.add("a");
  Record.add("a");
  EXPECT_TRUE(Record.has("a"));
  EXPECT_FALSE(Record.has("b"));
  EXPECT_TRUE(BuildRecord(Folder).has("a"));
  EXPECT_FALSE(BuildRecord("").has("a"));
  std::filesystem::remove_all(Folder);
  EXPECT_FALSE(Record.has("a"));
}

TEST(BuildRecord, WithoutAFolderNothingIsKept) {
  const BuildRecord None("");
  None.add("a");
  EXPECT_FALSE(None.has("a"));
}

} // namespace
} // namespace vorion::splat
