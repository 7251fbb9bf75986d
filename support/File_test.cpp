#include "FolderTest.h"
#include "vorion/support/File.h"

#include <cstdio>
#include <filesystem>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

using namespace vorion;

namespace {

using FileTest = FolderTest;

TEST_F(FileTest, RoundTripsAndLeavesNothingAside) {
  ASSERT_TRUE(writeFileAtomically(path("f"), std::string("abc\0d", 5)));
  const auto Bytes = readFile(path("f"));
  ASSERT_TRUE(Bytes);
  EXPECT_EQ(Bytes->size(), 5U);
  std::filesystem::remove(path("f"));
  EXPECT_TRUE(std::filesystem::is_empty(path(".")));
  const auto Gone = readFile(path("f"));
  ASSERT_FALSE(Gone);
  EXPECT_EQ(Gone.error().What,
            "cannot open: No such file or directory, expected a readable file");
}

TEST_F(FileTest, AFolderIsNoFile) {
  const auto Read = readFile(path(""));
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What,
            "cannot read: Is a directory, expected a readable file");
}

TEST_F(FileTest, AFileThatMemoryCannotHoldIsRefusedBeforeItIsRead) {
  ASSERT_TRUE(writeFileAtomically(path("huge"), "x"));
  // Sparse: it takes no room on the disk.
  ASSERT_EQ(::truncate(path("huge").c_str(), off_t{1} << 42), 0);
  const auto Read = readFile(path("huge"));
  ASSERT_FALSE(Read);
  EXPECT_TRUE(Read.error().What.starts_with(
      "a file of 4398046511104 bytes, expected at most "))
      << Read.error().What;
}

TEST_F(FileTest, AnEndlessDeviceIsReadToItsBound) {
  const auto Read = readFile("/dev/zero", 1 << 20);
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What,
            "more than 1048576 bytes, expected at most 1048576");
  const auto Empty = readFile("/dev/null");
  ASSERT_TRUE(Empty);
  EXPECT_TRUE(Empty->empty());
}

TEST_F(FileTest, WhatAFileNamesIsRegular) {
  ASSERT_TRUE(writeFileAtomically(path("f"), "abc"));
  const auto Bytes = readRegularFile(path("f"));
  ASSERT_TRUE(Bytes);
  EXPECT_EQ(Bytes->size(), 3U);
  const auto Start = readStart(path("f"), 2);
  ASSERT_TRUE(Start);
  EXPECT_EQ(Start->size(), 2U);
  ASSERT_EQ(readStart(path("f"), 9)->size(), 3U);
  EXPECT_FALSE(readRegularFile(path("f"), 2));

  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0); // with no writer
  std::filesystem::create_symlink("/dev/zero", path("device"));
  std::filesystem::create_symlink("nothing", path("dangling"));
  for (const auto &[Name, What] :
       {std::pair("pipe", "a pipe, expected a regular file"),
        std::pair("device", "a device, expected a regular file"),
        std::pair("", "a folder, expected a regular file"),
        std::pair("dangling", "cannot open: No such file or directory, "
                              "expected a readable file")}) {
    const auto Read = readRegularFile(path(Name));
    ASSERT_FALSE(Read) << Name;
    EXPECT_EQ(Read.error().What, What);
    EXPECT_FALSE(readStart(path(Name), 2)) << Name;
  }
}

TEST_F(FileTest, ANameWithANulIsNotThatOfAnotherFile) {
  ASSERT_TRUE(writeFileAtomically(path("f"), "abc"));
  const std::string Name = path("f") + std::string("\0g", 2);
  const auto Read = readFile(Name);
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What,
            "a NUL in the name, expected a name without one");
  EXPECT_FALSE(writeFileAtomically(Name, "d"));
  EXPECT_FALSE(checkWritable(Name));
  EXPECT_EQ(readFile(path("f"))->size(), 3U);
}

TEST_F(FileTest, APipeIsReadToItsEnd) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::thread Writer([this] {
    std::FILE *F = std::fopen(path("pipe").c_str(), "w");
    const std::string Text(200'000, 'a');
    std::fwrite(Text.data(), 1, Text.size(), F);
    std::fclose(F);
  });
  const auto Read = readFile(path("pipe"));
  Writer.join();
  ASSERT_TRUE(Read);
  EXPECT_EQ(Read->size(), 200'000U);
}

} // namespace
