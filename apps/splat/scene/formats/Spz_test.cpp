#include "io/Zstd.h"
#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

SceneFile parsed(const std::string &Content) {
  return parsedAs(SceneFormat::Spz, Content);
}

TEST(Spz, RoundTripsBothVersionsAtEveryDegree) {
  for (const int Version : {2, 3})
    for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
      const Scene S = randomScene(100, Degree, 7);
      const SceneFile Read = parsed(gzipOf(spzBodyOf(S, Version)));
      EXPECT_EQ(Read.Version, Version);
      EXPECT_FALSE(Read.DrawnAs.Antialiased);
      const auto D = differencesOf(Read.Gaussians, S);
      EXPECT_LE(D.Position, 0.5 / 4096 + 1e-6);
      EXPECT_LE(D.LogScale, 0.5 / 16 + 1e-6);
      EXPECT_LE(D.Opacity, 0.5 / 255 + 1e-6);
      EXPECT_LE(D.Color, 0.5 / 255 / 0.15 + 1e-6);
      // Half a bucket of 16, and half a step from rounding to the bucket.
      EXPECT_LE(D.Harmonics, 8.5 / 128 + 1e-6);
      EXPECT_GT(D.LogScale, 0);
      if (Version == 3) // half a step of three components
        EXPECT_LE(D.Rotation, 3 * std::sqrt(0.5) / 511 / 2 + 1e-6);
      // Version 2 derives w, which may be small: the three that are stored.
      for (std::size_t I = 0; Version == 2 && I < S.size(); ++I)
        for (std::size_t K = 1; K < 4; ++K)
          EXPECT_NEAR(Read.Gaussians.Quats[4 * I + K],
                      S.Quats[4 * I] < 0 ? -S.Quats[4 * I + K]
                                         : S.Quats[4 * I + K],
                      0.5 / 127.5 + 1e-6);
    }
}

TEST(Spz, IsReadAsWellWithoutCompression) {
  const Scene S = randomScene(3, 1, 7);
  const std::string Body = spzBodyOf(S, 3);
  EXPECT_EQ(parsed(Body).Gaussians.Quats, parsed(gzipOf(Body)).Gaussians.Quats);
}

TEST(Spz, Version4HasTheSameArrays) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    const Scene S = randomScene(300, Degree, 8);
    const SceneFile Read = parsed(spz4Of(S));
    EXPECT_EQ(Read.Version, 4);
    EXPECT_TRUE(Read.Skipped.empty());
    const auto D =
        differencesOf(Read.Gaussians, parsed(spzBodyOf(S, 3)).Gaussians);
    EXPECT_EQ(D.Position + D.LogScale + D.Rotation + D.Opacity + D.Color +
                  D.Harmonics,
              0);
  }
}

TEST(Spz, ExtensionsOfVersion4AreNamedAndSkipped) {
  const SceneFile Read = parsed(spz4Of(randomScene(3, 1, 7), "a record"));
  EXPECT_EQ(Read.Skipped, std::vector<std::string>{"extensions"});
  EXPECT_EQ(Read.Gaussians.size(), 3U);
}

TEST(Spz, EveryTruncationOfVersion4IsAnError) {
  const std::string File = spz4Of(randomScene(3, 1, 7));
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(File.data(), Size))))
        << Size;
}

TEST(Spz, AFrameThatGoesOnBeyondItsArrayIsAnError) {
  std::string File = spz4Of(randomScene(1, 0, 1));
  // Nine bytes of positions are claimed; 16 MiB are packed.
  const std::string Bomb = zstdOf(std::string(std::size_t(16) << 20, 'x'));
  const std::size_t Frame = 32 + 5 * 16;
  const auto Packed = load<uint64_t>(std::as_bytes(std::span(File)), 32);
  File.replace(Frame, Packed, Bomb);
  const uint64_t Size = Bomb.size();
  File.replace(32, 8, reinterpret_cast<const char *>(&Size), 8);
  const auto Read = parseScene("s", std::as_bytes(std::span(File)));
  ASSERT_FALSE(Read);
  EXPECT_NE(Read.error().What.find("goes on after 10 bytes, expected 9"),
            std::string::npos)
      << Read.error().What;
}

TEST(Spz, AStreamThatGoesOnBeyondTheHeadersCountIsAnError) {
  // One Gaussian, and then what Deflate packs a thousandfold.
  std::string Body = spzBodyOf(randomScene(1, 0, 1), 3);
  Body.resize(std::size_t(16) << 20);
  const std::string File = gzipOf(Body);
  const auto Read = parseScene("s", std::as_bytes(std::span(File)));
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What,
            "the gzip stream is too long, expected the size in its header");
}

TEST(Spz, BytesOfEachVersion) {
  std::string Body = spzBodyOf(randomScene(1, 0, 1), 3);
  const std::string Tail("\xff\xff\xff\x00\x10\x00\x00\x00\x80" // -1, 4096, min
                         "\x00"                                 // opacity
                         "\x00\x80\xff"                         // colour
                         "\x00\xa0\xff"                         // log scales
                         "\xff\x01\x00\xc0", // w missing; x 0, y 0, z 511
                         20);
  Body.replace(16, Tail.size(), Tail);
  Body[14] = 1; // trained with antialiasing
  const SceneFile Read = parsed(Body);
  const Scene &S = Read.Gaussians;
  EXPECT_TRUE(Read.DrawnAs.Antialiased);
  EXPECT_EQ(S.Means, (std::vector<float>{-1.0F / 4096, 1, -2048}));
  EXPECT_LT(activate<double>(S).Opacities[0], 1e-12);
  EXPECT_NEAR(S.Sh[0], -0.5 / 0.15, 1e-6);
  EXPECT_NEAR(S.Sh[2], 0.5 / 0.15, 1e-6);
  EXPECT_EQ(S.LogScales, (std::vector<float>{-10, 0, 5.9375}));
  EXPECT_NEAR(S.Quats[0], std::sqrt(0.5), 1e-6);
  EXPECT_EQ(S.Quats[1], 0);
  EXPECT_EQ(S.Quats[2], 0);
  EXPECT_NEAR(S.Quats[3], std::sqrt(0.5), 1e-6);

  std::string Older = spzBodyOf(randomScene(1, 0, 1), 2);
  Older.replace(Older.size() - 3, 3, std::string("\xff\xff\x00", 3));
  // Longer than a unit: w is zero, not the root of a negative number.
  EXPECT_EQ(parsed(Older).Gaussians.Quats, (std::vector<float>{0, 1, 1, -1}));
}

} // namespace
