#include "cameras/Motion.h"

#include "capture/Capture.h"
#include "capture/CaptureTest.h"

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

std::vector<Camera> circle() {
  const CaptureFolder F(transformsOf(sampleCapture()));
  const auto C = readCapture(F.path());
  std::vector<Camera> Cameras;
  for (const CaptureView &V : C->Views)
    Cameras.push_back(V.Pose);
  return Cameras;
}

Vector ahead(const Camera &C) {
  return {C.Rotation[0][2], C.Rotation[1][2], C.Rotation[2][2]};
}

TEST(Motion, WhatACircleOfCamerasLooksAtIsItsMiddle) {
  const auto Cameras = circle();
  const auto Centre = lookedAt(Cameras);
  ASSERT_TRUE(Centre);
  EXPECT_LT(length(*Centre), 1e-9);
  const auto Up = upOf(Cameras);
  ASSERT_TRUE(Up);
  EXPECT_NEAR((*Up)[1], -1, 1e-12);
}

// The mean of the three ups leans by 20 degrees.
TEST(Motion, ACameraThatLooksDownDoesNotTiltUp) {
  std::vector<Camera> Cameras;
  for (const auto &[Turn, Down] :
       {std::pair(0.0, 0.0), std::pair(0.5, 0.1), std::pair(0.3, 1.3)}) {
    Camera C = Camera::ahead(8, 6, 10);
    const Vector Forward{std::sin(Turn) * std::cos(Down), std::sin(Down),
                         std::cos(Turn) * std::cos(Down)};
    const Vector Right = unit(cross({0, 1, 0}, Forward));
    const Vector Below = cross(Forward, Right);
    for (std::size_t R = 0; R < 3; ++R)
      C.Rotation[R] = {Right[R], Below[R], Forward[R]};
    Cameras.push_back(C);
  }
  EXPECT_LT(length(*upOf(Cameras) - Vector{0, -1, 0}), 1e-9);
  // On its side, a camera counts by its own up.
  Camera &Portrait = Cameras.emplace_back(Camera::ahead(8, 6, 10));
  Portrait.Rotation = {{{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}}};
  EXPECT_GT(length(*upOf(Cameras) - Vector{0, -1, 0}), 0.2);
}

TEST(Motion, CamerasThatLookTheSameWayOrOutwardsLookAtNothing) {
  std::vector<Camera> Cameras(4, Camera::ahead(8, 6, 10));
  for (std::size_t I = 0; I < 4; ++I)
    Cameras[I].Position[0] = double(I);
  EXPECT_FALSE(lookedAt(Cameras));
  EXPECT_FALSE(lookedAt({Cameras[0]}));
  Cameras = circle();
  for (Camera &C : Cameras)
    C.Position = -1.0 * C.Position;
  EXPECT_FALSE(lookedAt(Cameras));
}

TEST(Motion, AnOrbitKeepsDistanceHeightAndWhatItLooksAt) {
  const Camera Start = circle()[1];
  const auto Views = orbit(Start, {0, 0, 0}, {0, -1, 0}, 12);
  ASSERT_EQ(Views.size(), 12U);
  EXPECT_EQ(Views[0].Position, Start.Position);
  EXPECT_EQ(Views[0].Rotation, Start.Rotation);
  EXPECT_EQ(Views[0].Name, "orbit-00");
  EXPECT_EQ(Views[11].Name, "orbit-11");
  for (const Camera &C : Views) {
    EXPECT_NEAR(length(C.Position), 3, 1e-12);
    EXPECT_NEAR(C.Position[1], Start.Position[1], 1e-12);
    EXPECT_TRUE(isRotation(C.Rotation));
    EXPECT_LT(length(C.Position + 3 * ahead(C)), 1e-12);
  }
  // Half around is opposite.
  EXPECT_LT(length(Views[6].Position + Start.Position), 1e-12);
}

TEST(Motion, APathGoesThroughItsKeysAndTurnsTheShorterWay) {
  const auto Keys = circle(); // 36 degrees from each to the next
  const auto Path = alongPath(Keys, 91);
  ASSERT_EQ(Path.size(), 91U);
  for (std::size_t I = 0; I < Path.size(); ++I) {
    EXPECT_TRUE(isRotation(Path[I].Rotation));
    if (I % 10 == 0) {
      EXPECT_LT(length(Path[I].Position - Keys[I / 10].Position), 1e-12);
      EXPECT_LT(length(ahead(Path[I]) - ahead(Keys[I / 10])), 1e-12);
    }
    // Near the circle all along, but for its ends where nothing leads on.
    if (I > 10 && I < 80) {
      EXPECT_NEAR(length(Path[I].Position), 3, 0.02);
      EXPECT_GT(dot(ahead(Path[I]), unit(-1.0 * Path[I].Position)), 0.999);
    }
  }
}

TEST(Motion, AnotherSizeKeepsTheFieldOfViewAndTheMiddle) {
  Camera C = Camera::ahead(80, 60, 40);
  C.Cx = 42;
  C.Cy = 31;
  const Camera R = resized(C, 160, 90);
  EXPECT_EQ(R.Fx, 80);
  EXPECT_EQ(R.Fy, 80);
  EXPECT_EQ(R.Cx, 84);
  EXPECT_EQ(R.Cy, 47);
  EXPECT_EQ(R.Width, 160);
  EXPECT_EQ(R.Height, 90);
}

} // namespace
