#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

Scene parsed(const std::string &Content) {
  return parsedAs(SceneFormat::CompressedPly, Content).Gaussians;
}

TEST(CompressedPly, RoundTripsWithinHalfAStepAtEveryDegree) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    const Scene S = randomScene(300, Degree, 7); // a whole chunk and a part
    const auto D = differencesOf(parsed(compressedPlyOf(S)), S);
    // Half of the coarser steps (10 bits) over at most the scene's extent.
    EXPECT_LE(D.Position, 100.0 / 1023 / 2 + 1e-5);
    EXPECT_LE(D.LogScale, 8.0 / 1023 / 2 + 1e-5);
    // Half a step of three components; the fourth takes at most their sum.
    EXPECT_LE(D.Rotation, 3 * std::sqrt(2) / 1023 / 2 + 1e-6);
    EXPECT_LE(D.Opacity, 0.5 / 255 + 1e-6);
    EXPECT_LE(D.Color, 1.8 / 255 / 2 + 1e-6); // bounds of 0.9 either way
    EXPECT_LE(D.Harmonics, 8.0 / 256 / 2 + 1e-6);
    EXPECT_GT(D.Position, 0); // the comparison sees something
  }
}

TEST(CompressedPly, OlderFilesHaveColoursFromZeroToOne) {
  Scene S = randomScene(10, 0, 8);
  const auto D = differencesOf(parsed(compressedPlyOf(S, {}, false)), S);
  EXPECT_LE(D.Color, 1 / ShC0 / 255 / 2 + 1e-6);
}

TEST(CompressedPly, WordsAreSplitFromTheTop) {
  Scene S = randomScene(1, 0, 9);
  std::string File = compressedPlyOf(S, {}, false);
  const std::size_t Body = File.find("end_header\n") + 11;
  // Bounds 0 to 2047, 0 to 1023, 0 to 2047, so that steps are whole numbers.
  const float Bounds[12] = {0, 0, 0, 2047, 1023, 2047,
                            0, 0, 0, 2047, 1023, 2047};
  const uint32_t Words[4] = {1U << 21 | 2U << 11 | 3U, // position
                             2U << 30 | 1023U << 20 | 511U << 10 |
                                 0, // rotation: y is missing
                             2047U << 21 | 1023U << 11 | 2046U, // scale
                             0xFF0080FFU}; // colour and opacity
  std::memcpy(File.data() + Body, Bounds, sizeof(Bounds));
  std::memcpy(File.data() + Body + sizeof(Bounds), Words, sizeof(Words));
  const Scene Read = parsed(File);
  EXPECT_EQ(Read.Means, (std::vector<float>{1, 2, 3}));
  EXPECT_EQ(Read.LogScales, (std::vector<float>{2047, 1023, 2046}));
  EXPECT_NEAR(Read.Quats[0], std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(Read.Quats[1], (511 / 1023.0 - 0.5) * std::sqrt(2), 1e-6);
  EXPECT_NEAR(Read.Quats[2], 0, 1e-3); // what is left of unit length
  EXPECT_NEAR(Read.Quats[3], -std::sqrt(0.5), 1e-6);
  EXPECT_NEAR(Read.Sh[0], 0.5 / ShC0, 1e-6);
  EXPECT_NEAR(Read.Sh[1], -0.5 / ShC0, 1e-6);
  EXPECT_NEAR(Read.Sh[2], (128 / 255.0 - 0.5) / ShC0, 1e-6);
  EXPECT_EQ(activate<float>(Read).Opacities[0], 1);
}

} // namespace
