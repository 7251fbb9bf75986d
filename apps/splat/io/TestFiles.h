/// A folder for one test's files, removed at its end.
#pragma once

#include "vorion/support/File.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <unistd.h>

namespace vorion::splat {

class TestFolder {
public:
  TestFolder() {
    const auto *Test = ::testing::UnitTest::GetInstance()->current_test_info();
    Root = std::filesystem::temp_directory_path() /
           (std::string("splat-io-") + Test->test_suite_name() + "-" +
            Test->name() + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(Root);
  }
  ~TestFolder() { std::filesystem::remove_all(Root); }
  TestFolder(const TestFolder &) = delete;
  TestFolder &operator=(const TestFolder &) = delete;

  std::string path(const std::string &Name) const { return Root / Name; }

  /// Writes \p Content under \p Name and gives the path.
  std::string write(const std::string &Name, const std::string &Content) const {
    EXPECT_TRUE(writeFileAtomically(path(Name), Content));
    return path(Name);
  }

  /// The content of \p Name.
  std::string read(const std::string &Name) const {
    const auto Bytes = readFile(path(Name));
    EXPECT_TRUE(Bytes);
    return Bytes ? std::string(reinterpret_cast<const char *>(Bytes->data()),
                               Bytes->size())
                 : "";
  }

private:
  std::filesystem::path Root;
};

} // namespace vorion::splat
