#include "vorion/support/Diagnostics.h"
#include "vorion/support/File.h"
#include "vorion/support/TemporaryFolder.h"

#include <filesystem>
#include <gtest/gtest.h>

using namespace vorion;

namespace {

std::string temporaryPath(const char *Name) {
  return (std::filesystem::temp_directory_path() /
          (std::string(Name) + std::to_string(getpid())))
      .string();
}

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

TEST(File, RoundTripsAndLeavesNothingAside) {
  const std::string Path = temporaryPath("vorion-support");
  ASSERT_TRUE(writeFileAtomically(Path, std::string("abc\0d", 5)));
  const auto Bytes = readFile(Path);
  ASSERT_TRUE(Bytes);
  EXPECT_EQ(Bytes->size(), 5u);
  std::filesystem::remove(Path);
  const auto Gone = readFile(Path);
  ASSERT_FALSE(Gone);
  EXPECT_EQ(Gone.error().What,
            "cannot open: No such file or directory, expected a readable file");
}

TEST(File, UnwritablePathIsAnErrorNamingIt) {
  const auto Result = writeFileAtomically("/nonexistent-folder/x", "y");
  ASSERT_FALSE(Result);
  EXPECT_EQ(Result.error().Where, "/nonexistent-folder/x");
  EXPECT_EQ(Result.error().What, "cannot write: No such file or directory, "
                                 "expected a folder that can be written");
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
            "cannot make a temporary folder: No such file or directory, "
            "expected TMPDIR to allow one");
}

} // namespace
