/// Helpers of the tests of captures.
#pragma once

#include "capture/testing/CaptureWriters.h"
#include "io/TestFiles.h"

#include <algorithm>
#include <cmath>

namespace vorion::splat::testing {

/// A temporary folder with \p Files, removed by the destructor.
class CaptureFolder {
public:
  explicit CaptureFolder(const Folder &Files) {
    for (const auto &[Name, Content] : Files) {
      std::filesystem::create_directories(
          std::filesystem::path(Root.path(Name)).parent_path());
      Root.write(Name, Content);
    }
  }
  std::string path(const std::string &Name = "") const {
    return Root.path(Name);
  }

private:
  TestFolder Root;
};

/// \p Text with \p What, which must occur, replaced.
inline std::string replaced(std::string Text, const std::string &What,
                            const std::string &With) {
  const std::size_t At = Text.find(What);
  EXPECT_NE(At, std::string::npos) << What;
  return At == std::string::npos ? Text : Text.replace(At, What.size(), With);
}

} // namespace vorion::splat::testing
