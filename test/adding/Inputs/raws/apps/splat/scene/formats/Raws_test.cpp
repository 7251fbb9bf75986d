#include "scene/SceneFile.h"

#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

std::string rawsOf(uint32_t Count) {
  std::string File("RAWS");
  File.append(reinterpret_cast<const char *>(&Count), sizeof(Count));
  for (uint32_t I = 0; I < 14 * Count; ++I) {
    const float Value = 0.5F + static_cast<float>(I);
    File.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
  }
  return File;
}

Expected<SceneFile> parsed(const std::string &File) {
  return parseScene("s", std::as_bytes(std::span(File)));
}

TEST(Raws, HasEachValueInItsPlace) {
  const auto Read = parsed(rawsOf(2));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Format, SceneFormat::Raws);
  EXPECT_EQ(name(Read->Format), "raws");
  EXPECT_EQ(Read->Gaussians.Means[3], 14.5F);
  EXPECT_EQ(Read->Gaussians.OpacityLogits[1], 24.5F);
  EXPECT_EQ(Read->Gaussians.Sh[5], 27.5F);
}

TEST(Raws, EveryTruncationIsAnError) {
  const std::string File = rawsOf(2);
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(parsed(File.substr(0, Size))) << Size;
}

} // namespace
