/// A folder of a test's own, which goes with it.
#pragma once

#include "vorion/support/TemporaryFolder.h"

#include <gtest/gtest.h>
#include <optional>
#include <string>
#include <utility>

namespace vorion {

class FolderTest : public testing::Test {
protected:
  void SetUp() override {
    auto Made = TemporaryFolder::make("vorion-support");
    ASSERT_TRUE(Made);
    Folder.emplace(std::move(*Made));
  }
  std::string path(const std::string &Name) const {
    return Folder->path() + "/" + Name;
  }

private:
  std::optional<TemporaryFolder> Folder;
};

} // namespace vorion
