#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

Scene parsed(const std::string &Content) {
  return parsedAs(SceneFormat::KSplat, Content).Gaussians;
}

TEST(KSplat, RoundTripsWithinEachCompressionsSteps) {
  const double Half = 1.0 / 2048; // relative error of a half
  const struct {
    double Position, LogScale, Quat, Harmonic;
  } Most[] = {{0, 1e-6, 1e-6, 0},
              {200.0 / 65534 / 2 + 1e-5, Half, 2 * Half, Half},
              {200.0 / 65534 / 2 + 1e-5, Half, 2 * Half, 1.0 / 255 + 1e-6}};
  for (int Compression = 0; Compression <= 2; ++Compression)
    for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
      // Sections of 22 and 23: full buckets of eight and one that is not.
      const Scene S = randomScene(45, Degree, 7);
      const auto D = differencesOf(parsed(ksplatOf(S, Compression)), S);
      EXPECT_LE(D.Position, Most[Compression].Position) << Compression;
      EXPECT_LE(D.LogScale, Most[Compression].LogScale) << Compression;
      EXPECT_LE(D.Rotation, Most[Compression].Quat) << Compression;
      EXPECT_LE(D.Harmonics, Most[Compression].Harmonic) << Compression;
      EXPECT_LE(D.Opacity, 0.5 / 255 + 1e-6);
      EXPECT_LE(D.Color, 0.5 / ShC0 / 255 + 1e-6);
    }
}

TEST(KSplat, EveryTruncationIsAnError) {
  const std::string File = ksplatOf(randomScene(5, 1, 3), 2);
  for (std::size_t Size = 64; Size < File.size(); ++Size)
    EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(File.data(), Size))))
        << Size;
}

TEST(KSplat, HalvesOfEveryKind) {
  const std::string Whole = ksplatOf(randomScene(2, 0, 3), 1);
  // The first record's scales, behind the headers, a bucket's count and centre.
  const std::size_t Scales = 4096 + 2 * 1024 + 4 + 12 + 6;
  const auto ScaleOf = [&](uint16_t Half) {
    std::string File = Whole;
    File.replace(Scales, 2, reinterpret_cast<const char *>(&Half), 2);
    return std::exp(double(parsed(File).LogScales[0]));
  };
  EXPECT_NEAR(ScaleOf(0x3C00), 1, 1e-6);
  EXPECT_NEAR(ScaleOf(0x7BFF), 65504, 0.1);
  EXPECT_NEAR(ScaleOf(0x0001), std::ldexp(1, -24), 1e-13); // the least of all
  EXPECT_NEAR(ScaleOf(0x0400), std::ldexp(1, -14), 1e-10);
  std::string Infinite = Whole;
  Infinite.replace(Scales, 2, std::string("\x00\x7c", 2));
  EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(Infinite))));
}

} // namespace
