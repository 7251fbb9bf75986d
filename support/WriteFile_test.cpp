#include "FolderTest.h"
#include "vorion/support/File.h"

#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <sys/stat.h>
#include <sys/sysmacros.h>
#include <thread>

using namespace vorion;
namespace fs = std::filesystem;

namespace {

class WriteFileTest : public FolderTest {
protected:
  static std::string contentOf(const std::string &Path) {
    std::ifstream In(Path, std::ios::binary);
    return {std::istreambuf_iterator<char>(In), {}};
  }
  /// Nothing was left beside the \p Count entries that belong there.
  void expectEntries(std::ptrdiff_t Count) const {
    EXPECT_EQ(std::distance(fs::directory_iterator(path("")), {}), Count);
  }
  static std::string errorOf(const Expected<Success> &E) {
    return E ? std::string() : E.error().What;
  }
};

TEST_F(WriteFileTest, ANewFileHasTheRightsOfAllNewFiles) {
  const mode_t Old = ::umask(027);
  const auto Written = writeFileAtomically(path("f"), "text");
  ::umask(Old);
  ASSERT_TRUE(Written);
  EXPECT_EQ(contentOf(path("f")), "text");
  struct stat Info{};
  ASSERT_EQ(::stat(path("f").c_str(), &Info), 0);
  EXPECT_EQ(Info.st_mode & 07777, 0640U);
  expectEntries(1);
}

TEST_F(WriteFileTest, AReplacedFileKeepsItsRights) {
  ASSERT_TRUE(writeFileAtomically(path("f"), "old"));
  ASSERT_EQ(::chmod(path("f").c_str(), 04604), 0);
  ASSERT_TRUE(writeFileAtomically(path("f"), "new"));
  EXPECT_EQ(contentOf(path("f")), "new");
  struct stat Info{};
  ASSERT_EQ(::stat(path("f").c_str(), &Info), 0);
  EXPECT_EQ(Info.st_mode & 07777, 0604U) << "but for set-user-ID";
  expectEntries(1);
}

TEST_F(WriteFileTest, ALinkStaysAndItsTargetGetsTheContent) {
  fs::create_directory(path("sub"));
  ASSERT_TRUE(writeFileAtomically(path("sub/f"), "old"));
  fs::create_symlink("sub/f", path("near"));
  fs::create_symlink(path("near"), path("far"));
  ASSERT_TRUE(writeFileAtomically(path("far"), "new"));
  EXPECT_TRUE(fs::is_symlink(path("far")));
  EXPECT_TRUE(fs::is_symlink(path("near")));
  EXPECT_EQ(contentOf(path("sub/f")), "new");
  fs::create_symlink("sub/none", path("dangling"));
  ASSERT_TRUE(writeFileAtomically(path("dangling"), "made"));
  EXPECT_TRUE(fs::is_symlink(path("dangling")));
  EXPECT_EQ(contentOf(path("sub/none")), "made");
}

TEST_F(WriteFileTest, ALinkToItselfIsAnError) {
  fs::create_symlink("loop", path("loop"));
  for (const auto &Result :
       {writeFileAtomically(path("loop"), "text"), checkWritable(path("loop"))})
    EXPECT_TRUE(errorOf(Result).starts_with("cannot write: Too many levels"))
        << errorOf(Result);
}

TEST_F(WriteFileTest, APipeIsWrittenThrough) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_TRUE(checkWritable(path("pipe")));
  std::string Got;
  std::thread Reader([&] { Got = contentOf(path("pipe")); });
  const std::string Text(300'000, 'a');
  EXPECT_TRUE(writeFileAtomically(path("pipe"), Text));
  Reader.join();
  EXPECT_EQ(Got, Text);
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

TEST_F(WriteFileTest, ADeviceIsWrittenThrough) {
  // The null device, by a name of our own.
  if (::mknod(path("null").c_str(), S_IFCHR | 0600, ::makedev(1, 3)) != 0)
    GTEST_SKIP() << "devices cannot be made here";
  EXPECT_TRUE(checkWritable(path("null")));
  EXPECT_TRUE(writeFileAtomically(path("null"), "text"));
  EXPECT_TRUE(fs::is_character_file(path("null")));
  expectEntries(1);
}

TEST_F(WriteFileTest, ADeviceWithoutRoomIsAnError) {
  // Full, by a name of our own: a mistake must not cost the machine's.
  if (::mknod(path("full").c_str(), S_IFCHR | 0600, ::makedev(1, 7)) != 0)
    GTEST_SKIP() << "devices cannot be made here";
  EXPECT_EQ(errorOf(writeFileAtomically(path("full"), "text")),
            "cannot write: No space left on device, expected a device or a "
            "pipe that accepts it");
}

TEST_F(WriteFileTest, StandardOutputHasAName) {
  testing::internal::CaptureStdout();
  std::printf("before ");
  EXPECT_TRUE(writeFileAtomically("-", "text"));
  fs::create_symlink("/proc/self/fd/1", path("stdout"));
  EXPECT_TRUE(writeFileAtomically(path("stdout"), " again"));
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "before text again");
}

TEST_F(WriteFileTest, NamesMayBeAsLongAsTheFolderTakes) {
  const std::string Longest(255, 'n'), Longer(256, 'n');
  EXPECT_TRUE(checkWritable(path(Longest)));
  EXPECT_TRUE(writeFileAtomically(path(Longest), "text"));
  expectEntries(1);
  EXPECT_EQ(errorOf(checkWritable(path(Longer))),
            "cannot write: File name too long, expected a folder that can be "
            "written");
}

TEST_F(WriteFileTest, FoldersAreNoFiles) {
  constexpr const char *Folder = "cannot write: is a folder, expected a file";
  EXPECT_EQ(errorOf(checkWritable(path(""))), Folder);
  EXPECT_EQ(errorOf(writeFileAtomically(path(""), "text")), Folder);
}

TEST_F(WriteFileTest, FilesThatBelongTogetherAreAllOldOrAllNew) {
  ASSERT_TRUE(writeFilesTogether({{path("a"), "old"}, {path("index"), "1"}}));
  fs::create_directory(path("b"));
  EXPECT_EQ(
      errorOf(writeFilesTogether(
          {{path("a"), "new"}, {path("b"), "new"}, {path("index"), "2"}})),
      "cannot write: is a folder, expected a file");
  EXPECT_EQ(contentOf(path("a")), "old");
  EXPECT_EQ(contentOf(path("index")), "1");
  expectEntries(3);
  fs::remove(path("b"));
  EXPECT_TRUE(writeFilesTogether(
      {{path("a"), "new"}, {path("b"), "new"}, {path("index"), "2"}}));
  EXPECT_EQ(contentOf(path("a")) + contentOf(path("b")), "newnew");
  EXPECT_EQ(contentOf(path("index")), "2");
  expectEntries(3);
  // Nothing is beside a pipe that could take its place.
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  EXPECT_EQ(
      errorOf(writeFilesTogether({{path("a"), "x"}, {path("pipe"), "y"}})),
      "cannot write: is a device or a pipe, expected a file");
  EXPECT_EQ(contentOf(path("a")), "new");
}

TEST_F(WriteFileTest, UnwritablePathIsAnErrorNamingIt) {
  for (const auto &Result : {writeFileAtomically("/nonexistent-folder/x", "y"),
                             checkWritable("/nonexistent-folder/x")}) {
    ASSERT_FALSE(Result);
    EXPECT_EQ(Result.error().Where, "/nonexistent-folder/x");
    EXPECT_EQ(Result.error().What, "cannot write: No such file or directory, "
                                   "expected a folder that can be written");
  }
}

} // namespace
