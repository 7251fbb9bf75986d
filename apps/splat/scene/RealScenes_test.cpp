// Scenes that others trained and packed: the same scene in two formats.
#include "scene/SceneFile.h"
#include "scene/testing/Compare.h"
#include "scene/testing/Invariants.h"

#include <algorithm>
#include <filesystem>
#include <numeric>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

const std::string Folder = "../shared/data/scenes/";

#define NEEDS(FILE)                                                            \
  if (!std::filesystem::exists(Folder + (FILE)))                               \
  GTEST_SKIP() << "no " << Folder << (FILE)

struct RealScene {
  const char *File;
  SceneFormat Format;
  std::size_t Count;
  int ShDegree;
};

class RealScenes : public ::testing::TestWithParam<RealScene> {};

TEST_P(RealScenes, AreReadWhole) {
  const RealScene &R = GetParam();
  NEEDS(R.File);
  const auto Read = readScene(Folder + R.File);
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Format, R.Format);
  EXPECT_EQ(Read->Gaussians.size(), R.Count);
  EXPECT_EQ(Read->Gaussians.ShDegree, R.ShDegree);
  EXPECT_TRUE(isWhole(Read->Gaussians));
}

INSTANTIATE_TEST_SUITE_P(
    All, RealScenes,
    ::testing::Values(
        RealScene{"airplane_needles.splat", SceneFormat::Splat, 26108, 0},
        RealScene{"bouquet_sh3.v3.spz", SceneFormat::Spz, 116549, 3},
        RealScene{"box_sh3.ply", SceneFormat::Ply, 78567, 3},
        RealScene{"guitar.compressed.ply", SceneFormat::CompressedPly, 90854,
                  0},
        RealScene{"playbot_sh2.sog.d", SceneFormat::Sog, 125000, 2},
        RealScene{"showroom_indoor.sog.d", SceneFormat::StreamedSog, 746973, 0},
        RealScene{"statue.sog", SceneFormat::Sog, 71359, 0}),
    [](const auto &Info) {
      std::string Name = Info.param.File;
      std::replace(Name.begin(), Name.end(), '.', '_');
      return Name;
    });

/// This PLY is what another program decoded from this SPZ, and wrote as
/// floats: decoding differs by rounding, not by quantisation.
TEST(RealScene, BoxIsTheSameInPlyAndSpz) {
  NEEDS("box_sh3.ply");
  NEEDS("box_sh3.v2.spz");
  const auto Ply = readScene(Folder + "box_sh3.ply"),
             Spz = readScene(Folder + "box_sh3.v2.spz");
  ASSERT_TRUE(Ply && Spz);
  EXPECT_EQ(Spz->Version, 2);
  const auto D = differencesOf(Spz->Gaussians, Ply->Gaussians);
  // 24 bits, sixteenths and hundred-and-twenty-eighths are exact in floats.
  EXPECT_EQ(D.Position, 0);
  EXPECT_EQ(D.LogScale, 0);
  EXPECT_EQ(D.Harmonics, 0);
  EXPECT_LE(D.Color, 2e-7);
  EXPECT_LE(D.Rotation, 1e-7);
  EXPECT_LE(D.Opacity, 2e-6); // the other program keeps 1e-6 from 0 and 1
}

} // namespace
