#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

Scene parsed(const std::string &Content) {
  return parsedAs(SceneFormat::Splat, Content).Gaussians;
}

TEST(Splat, RoundTripsWithinAStep) {
  const Scene S = randomScene(300, 0, 7);
  const Scene Read = parsed(splatOf(S));
  EXPECT_EQ(Read.Means, S.Means); // floats, as they are
  const auto D = differencesOf(Read, S);
  EXPECT_LE(D.LogScale, 1e-6); // exp and log, each rounded
  EXPECT_LE(D.Opacity, 0.5 / 255 + 1e-6);
  EXPECT_LE(D.Color, 0.5 / ShC0 / 255 + 1e-6);
  // Half a step of 1/128 each, and 1 is cut to 127/128. Making the length 1
  // again may move one by the others' share, so by no more than all four.
  EXPECT_LE(D.Rotation, 4.0 / 128);
}

TEST(Splat, BytesOfARecord) {
  std::string Record;
  for (const float V : {1.0F, -2.0F, 3.0F, 1.0F, 0.0F, std::exp(1.0F)})
    Record.append(reinterpret_cast<const char *>(&V), sizeof(V));
  Record += std::string("\x00\xff\x80\xff\xc0\x40\xc0\xc0", 8);
  const Scene S = parsed(Record);
  EXPECT_EQ(S.Means, (std::vector<float>{1, -2, 3}));
  EXPECT_EQ(S.LogScales[0], 0);
  EXPECT_NEAR(S.LogScales[1], -87.3365, 1e-4); // zero: smallest normal float
  EXPECT_NEAR(S.LogScales[2], 1, 1e-7);
  EXPECT_NEAR(S.Sh[0], -0.5 / ShC0, 1e-6);
  EXPECT_NEAR(S.Sh[1], 0.5 / ShC0, 1e-6);
  EXPECT_EQ(activate<float>(S).Opacities[0], 1);
  EXPECT_EQ(S.Quats, (std::vector<float>{0.5, -0.5, 0.5, 0.5}));
}

/// \p Count equal records with the scales \p X, 0.01, 0.01 and the rotation
/// 255, 0, 0, 0.
std::string unrotated(float X, std::size_t Count) {
  std::string Record;
  for (const float V : {1.0F, 2.0F, 3.0F, X, 0.01F, 0.01F})
    Record.append(reinterpret_cast<const char *>(&V), sizeof(V));
  Record += std::string("\x80\x80\x80\xff\xff\0\0\0", 8);
  std::string Content;
  for (std::size_t I = 0; I < Count; ++I)
    Content += Record;
  return Content;
}

TEST(Splat, RotationsOfSpheresNeedNoLength) {
  EXPECT_EQ(parsed(unrotated(0.01F, 3)).size(), 3);
  const std::string Longer = unrotated(0.02F, 3);
  EXPECT_FALSE(parseScene("a.splat", std::as_bytes(std::span(Longer))));
}

TEST(Splat, AnotherLengthIsToldWithWhatIsLeftOver) {
  const std::string Content(100, '\0');
  const auto Read = parseScene("a.splat", std::as_bytes(std::span(Content)));
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What, "100 bytes, 4 after the last complete Gaussian, "
                               "expected a .splat of 32 bytes per Gaussian");
}

} // namespace
