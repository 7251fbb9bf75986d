#include "vorion/support/RemovedAtEnd.h"

#include "FolderTest.h"
#include "vorion/support/Tool.h"

#include <csignal>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

using namespace vorion;

namespace {

using RemovedAtEndTest = FolderTest;
namespace fs = std::filesystem;

/// A folder with files, and a folder in it, and a link out of it.
void fill(const std::string &Folder, const std::string &Elsewhere) {
  fs::create_directories(Folder + "/in/ner");
  for (int I = 0; I != 100; ++I)
    std::ofstream(Folder + "/in/file-" + std::to_string(I)) << "text";
  fs::create_directory_symlink(Elsewhere, Folder + "/in/link");
}

TEST_F(RemovedAtEndTest, FilesAndFoldersGoAndTheSignalEndsTheProcess) {
  const std::string Kept = path("kept");
  fs::create_directory(Kept);
  std::ofstream(Kept + "/file") << "text";
  for (const int Number : {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM}) {
    EXPECT_EXIT(
        {
          signal(Number, SIG_DFL);
          catchEndingSignals();
          fill(path("gone"), Kept);
          std::ofstream(path("file")) << "text";
          const RemovedAtEnd Folder(path("gone"));
          const RemovedAtEnd File(path("file"));
          raise(Number);
          _exit(1);
        },
        testing::KilledBySignal(Number), "");
    EXPECT_FALSE(fs::exists(path("gone"))) << Number;
    EXPECT_FALSE(fs::exists(path("file"))) << Number;
    EXPECT_TRUE(fs::exists(Kept + "/file")) << Number;
  }
}

TEST_F(RemovedAtEndTest, TemporaryFoldersAreAmongThem) {
  setenv("TMPDIR", path("").c_str(), 1);
  EXPECT_EXIT(
      {
        catchEndingSignals();
        const auto Folder = TemporaryFolder::make("vorion-support");
        if (fs::exists(Folder->path()))
          raise(SIGTERM);
        _exit(1);
      },
      testing::KilledBySignal(SIGTERM), "");
  unsetenv("TMPDIR");
  EXPECT_TRUE(fs::is_empty(path("")));
}

TEST_F(RemovedAtEndTest, WhatIsNotHeldAnyMoreStays) {
  fs::create_directory(path("kept"));
  EXPECT_EXIT(
      {
        catchEndingSignals();
        {
          const RemovedAtEnd Folder(path("kept"));
        }
        raise(SIGTERM);
      },
      testing::KilledBySignal(SIGTERM), "");
  EXPECT_TRUE(fs::exists(path("kept")));
}

TEST_F(RemovedAtEndTest, AChildDoesNotRemoveWhatIsItsParents) {
  fs::create_directory(path("parents"));
  EXPECT_EXIT(
      {
        catchEndingSignals();
        const RemovedAtEnd Folder(path("parents"));
        const pid_t Child = fork();
        if (Child == 0)
          raise(SIGTERM);
        int Status = 0;
        waitpid(Child, &Status, 0);
        _exit(WIFSIGNALED(Status) && fs::exists(path("parents")) ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST_F(RemovedAtEndTest, IgnoredSignalsStayIgnored) {
  EXPECT_EXIT(
      {
        signal(SIGHUP, SIG_IGN);
        catchEndingSignals();
        raise(SIGHUP);
        _exit(0);
      },
      testing::ExitedWithCode(0), "");
}

} // namespace
