// Whatever happened to a file, its reader says so in one line, or gives a
// scene that is whole.
#include "scene/testing/Damage.h"
#include "scene/testing/Invariants.h"

#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

Expected<SceneFile> parsed(const std::string &Content) {
  return parseScene("file", std::as_bytes(std::span(Content)));
}

/// Whether \p Content is refused; either way as it should be.
bool refused(const std::string &Content, const std::string &About) {
  const auto Read = parsed(Content);
  if (Read) {
    EXPECT_TRUE(isWhole(Read->Gaussians)) << About;
    return false;
  }
  EXPECT_EQ(Read.error().Code, ExitCode::InputFile) << About;
  EXPECT_TRUE(Read.error().Where.starts_with("file")) << About;
  EXPECT_FALSE(Read.error().What.empty()) << About;
  for (const std::string &Text : {Read.error().Where, Read.error().What})
    EXPECT_EQ(Text, escaped(Text)) << About;
  return true;
}

TEST(Damage, WholeFilesAreRead) {
  for (const SampleFile &F : sampleFiles()) {
    const auto Read = parsed(F.Content);
    ASSERT_TRUE(Read) << F.Name << ": " << Read.error().What;
    EXPECT_TRUE(isWhole(Read->Gaussians)) << F.Name;
    EXPECT_EQ(Read->Gaussians.size(), 5U) << F.Name;
  }
}

TEST(Damage, EachKindHasItsMessage) {
  for (const DamagedFile &F : damagedFiles()) {
    const auto Read = parsed(F.Content);
    ASSERT_FALSE(Read) << F.Name;
    EXPECT_TRUE(refused(F.Content, F.Name));
    const std::string Message = Read.error().Where + ": " + Read.error().What;
    EXPECT_NE(Message.find(F.Message), std::string::npos)
        << F.Name << ": " << Message;
  }
}

/// Every byte of a small file, every so many of a larger one.
std::size_t stepOf(const SampleFile &F) {
  constexpr std::size_t Tries = 1000;
  return F.Content.size() / Tries + 1;
}

TEST(Damage, EveryTruncationIsAnError) {
  for (const SampleFile &F : sampleFiles())
    for (std::size_t Size = 0; Size < F.Content.size(); Size += stepOf(F)) {
      // Whole records of a .splat are a smaller scene.
      if (F.Name.ends_with(".splat") && Size > 0 && Size % 32 == 0)
        continue;
      EXPECT_TRUE(refused(F.Content.substr(0, Size), F.Name))
          << F.Name << " cut to " << Size << " bytes";
    }
}

TEST(Damage, EveryDamagedByteIsReadOrRefused) {
  for (const SampleFile &F : sampleFiles()) {
    std::size_t Refused = 0;
    for (std::size_t At = 0; At < F.Content.size(); At += stepOf(F))
      for (const char Byte : {'\0', '\xff', '9'}) {
        std::string Damaged = F.Content;
        Damaged[At] = Byte;
        Refused += refused(Damaged, F.Name);
      }
    EXPECT_GT(Refused, 0U) << F.Name;
  }
}

} // namespace
