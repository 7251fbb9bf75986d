#include "vorion/support/Outputs.h"

#include "FolderTest.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <vector>

using namespace vorion;
namespace fs = std::filesystem;

namespace {

class OutputsTest : public FolderTest {
protected:
  void SetUp() override {
    FolderTest::SetUp();
    ASSERT_FALSE(HasFatalFailure());
    ASSERT_TRUE(writeFileAtomically(path("a"), "text"));
  }
  /// Whether two outputs, and an output and an input, clash.
  static bool clash(const std::string &A, const std::string &B) {
    const std::vector<NamedFile> First{{"-o", A}}, Second{{"--json", B}};
    const auto Apart = claimOutputs(Second, First);
    const auto Both = claimOutputs(std::vector<NamedFile>{First[0], Second[0]});
    EXPECT_EQ(bool(Apart), bool(Both)) << A << ", " << B;
    if (!Both) {
      EXPECT_EQ(Both.error().What,
                "is the file of both -o and --json, expected two files");
      EXPECT_EQ(Both.error().Code, ExitCode::Usage);
    }
    return !Both;
  }
};

TEST_F(OutputsTest, OneFileUnderTwoNamesIsRefused) {
  fs::create_hard_link(path("a"), path("hard"));
  fs::create_symlink("a", path("soft"));
  fs::create_symlink("new", path("dangling"));
  fs::create_directory(path("sub"));
  EXPECT_TRUE(clash(path("a"), path("a")));
  EXPECT_TRUE(clash(path("a"), path("sub/../a")));
  EXPECT_TRUE(clash(path("a"), path("hard")));
  EXPECT_TRUE(clash(path("a"), path("soft")));
  EXPECT_TRUE(clash(path("new"), path("./new"))) << "not there yet";
  EXPECT_TRUE(clash(path("new"), path("sub/../new")));
  EXPECT_TRUE(clash(path("new"), path("dangling")));
  EXPECT_TRUE(clash("-", "-"));
}

TEST_F(OutputsTest, TwoFilesAreFine) {
  EXPECT_FALSE(clash(path("a"), path("b")));
  EXPECT_FALSE(clash(path("b"), path("c")));
  EXPECT_FALSE(clash(path("b"), "-"));
  EXPECT_FALSE(clash("", "")) << "not asked for";
}

TEST_F(OutputsTest, DevicesAndPipesMayBeNamedTwice) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_FALSE(clash(path("pipe"), path("pipe")));
  EXPECT_FALSE(clash("/dev/null", "/dev/null"));
}

TEST_F(OutputsTest, WhatCannotBeWrittenIsRefusedBeforeTheWork) {
  const auto Checked =
      claimOutputs(std::vector<NamedFile>{{"-o", path("none/x")}});
  ASSERT_FALSE(Checked);
  EXPECT_EQ(Checked.error().What, "cannot write: No such file or directory, "
                                  "expected a folder that can be written");
  EXPECT_EQ(Checked.error().Code, ExitCode::InputFile);
}

} // namespace
