#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/Letters.h"
#include "vorion/support/TemporaryFolder.h"

#include <filesystem>
#include <gtest/gtest.h>

using namespace vorion;

namespace {

TEST(Expected, HoldsAValueOrAnError) {
  Expected<int> Value = 3;
  ASSERT_TRUE(Value);
  EXPECT_EQ(*Value, 3);
  Expected<int> Failed = Error{"f", "wrong"};
  ASSERT_FALSE(Failed);
  EXPECT_EQ(Failed.error().What, "wrong");
  EXPECT_EQ(Failed.error().Code, ExitCode::InputFile);
}

TEST(Diagnostics, HasTheHouseForm) {
  testing::internal::CaptureStderr();
  const int Code = reportError("tool", Error{"file:3", "bad, expected good"});
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "tool: error: file:3: bad, expected good\n");
  EXPECT_EQ(Code, 3);
}

TEST(Letters, OneThingIsSingular) {
  EXPECT_EQ(counted(0, "place"), "0 places");
  EXPECT_EQ(counted(1, "place"), "1 place");
  EXPECT_EQ(counted(64, "finding"), "64 findings");
}

TEST(TemporaryFolder, GoesWithWhatIsInIt) {
  std::string Path;
  {
    auto Folder = TemporaryFolder::make("vorion-support");
    ASSERT_TRUE(Folder);
    const TemporaryFolder Moved = std::move(*Folder);
    Path = Moved.path();
    ASSERT_TRUE(writeFileAtomically(Path + "/file", "text"));
  }
  EXPECT_FALSE(std::filesystem::exists(Path));
}

TEST(TemporaryFolder, NeedsOneToBeIn) {
  setenv("TMPDIR", "/nonexistent-folder", 1);
  const auto Folder = TemporaryFolder::make("vorion-support");
  unsetenv("TMPDIR");
  ASSERT_FALSE(Folder);
  EXPECT_EQ(Folder.error().What,
            "cannot create a temporary folder: No such file or directory, "
            "expected TMPDIR to name a writable folder");
}

} // namespace
