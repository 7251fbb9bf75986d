// A camera's way while it exposes, and how files say it.

#include "io/Cameras.h"
#include "io/TestFiles.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

CameraPlace turnedAbout(std::size_t Axis, double Angle,
                        std::array<double, 3> Position) {
  const double C = std::cos(Angle), S = std::sin(Angle);
  const std::size_t J = (Axis + 1) % 3, K = (Axis + 2) % 3;
  CameraPlace P{Position, {}};
  P.Rotation[Axis][Axis] = 1;
  P.Rotation[J][J] = P.Rotation[K][K] = C;
  P.Rotation[K][J] = S;
  P.Rotation[J][K] = -S;
  return P;
}

void expectNear(const CameraPlace &A, const CameraPlace &B) {
  for (std::size_t I = 0; I < 3; ++I) {
    EXPECT_NEAR(A.Position[I], B.Position[I], 1e-14);
    for (std::size_t J = 0; J < 3; ++J)
      EXPECT_NEAR(A.Rotation[I][J], B.Rotation[I][J], 1e-14);
  }
}

TEST(RollingShutter, AWayGoesEvenlyFromOnePlaceToTheOther) {
  for (const double Turn : {0., 1e-9, 0.3, -1.5}) {
    const CameraPlace From = turnedAbout(1, 0.4, {1, 2, 3});
    const CameraPlace To = turnedAbout(1, 0.4 + Turn, {2, 0, 3.5});
    const auto Way = wayBetween(From, To);
    ASSERT_TRUE(Way);
    const auto &[Middle, Shutter] = *Way;
    expectNear(placeAt(Middle, Shutter, 0), From);
    expectNear(placeAt(Middle, Shutter, 1), To);
    expectNear(placeAt(Middle, Shutter, 0.25),
               turnedAbout(1, 0.4 + Turn / 4, {1.25, 1.5, 3.125}));
  }
}

TEST(RollingShutter, LargeTurnsAreRefused) {
  const auto Way = wayBetween(turnedAbout(2, 0, {}), turnedAbout(2, 2, {}));
  ASSERT_FALSE(Way);
  EXPECT_EQ(Way.error().What, "a camera that rotates by 115 degrees during the "
                              "exposure, expected at most 90");
}

TEST(RollingShutter, FilesKeepItToTheBit) {
  const TestFolder Folder;
  Camera C = Camera::ahead(64, 48, 50);
  C.Name = "rolling";
  C.Optics.Shutter = {0.1, -0.2, 0.7, {0.1, 1. / 3, -5}, {0.2, -1. / 7, 0.3}};
  const std::string File = Folder.path("c.json");
  ASSERT_TRUE(writeCameras(File, {C}));
  const auto Read = readCameras(File);
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->front(), C);
}

TEST(RollingShutter, NamesSayWhichRowsComeFirst) {
  const TestFolder Folder;
  const auto Read = [&](const std::string &Keys) {
    return readCameras(Folder.write(
        "c.json",
        R"([{"id": 0, "img_name": "a", "width": 8, "height": 8, "fx": 5,
             "fy": 5, "position": [0, 0, 0],
             "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], )" +
            Keys + "}]"));
  };
  const auto Up = Read(R"("rolling_shutter": "ROLLING_BOTTOM_TO_TOP",
                          "rolling_turn": [0, 0.1, 0])");
  ASSERT_TRUE(Up) << Up.error().What;
  EXPECT_EQ(Up->front().Optics.Shutter,
            (RollingShutter{1, 0, -1, {}, {0, 0.1, 0}}));
  const auto Still = Read(R"("rolling_shutter": "ROLLING_TOP_TO_BOTTOM",
                             "rolling_motion": [0, 0, 0])");
  ASSERT_TRUE(Still) << Still.error().What;
  EXPECT_EQ(Still->front().Optics, CameraModel());
}

} // namespace
