#include "train/data/Start.h"

#include "scene/Activation.h"
#include "train/data/Neighbours.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>
#include <random>

using namespace vorion::splat;

namespace {

double distance(const std::vector<float> &P, std::size_t A, std::size_t B) {
  double Squares = 0;
  for (std::size_t K = 0; K < 3; ++K)
    Squares += std::pow(double(P[3 * A + K]) - P[3 * B + K], 2.0);
  return std::sqrt(Squares);
}

TEST(Neighbours, AreThoseOfTryingAll) {
  std::mt19937 Random(5);
  std::normal_distribution<float> Normal;
  for (const std::size_t Count : {2U, 3U, 4U, 9U, 100U, 500U}) {
    std::vector<float> P;
    for (std::size_t I = 0; I < 3 * Count; ++I)
      P.push_back(Normal(Random));
    // Some that coincide, and some in a plane.
    for (std::size_t I = 0; I + 6 <= P.size() / 4; ++I)
      P[I + 3] = P[I];
    const auto Means = meanNeighbourDistances(P);
    for (std::size_t I = 0; I < Count; ++I) {
      std::vector<double> D;
      for (std::size_t J = 0; J < Count; ++J)
        if (I != J)
          D.push_back(distance(P, I, J));
      std::ranges::sort(D);
      D.resize(std::min<std::size_t>(D.size(), 3));
      double Mean = 0;
      for (const double V : D)
        Mean += V / static_cast<double>(D.size());
      EXPECT_NEAR(Means[I], Mean, 1e-12) << I << " of " << Count;
    }
  }
}

// Each point would otherwise be compared with every other one.
TEST(Neighbours, AMillionInOnePlaceTakeNoTimeEach) {
  const std::vector<float> P(3 * 1'000'000, 1.5F);
  EXPECT_EQ(meanNeighbourDistances(P), std::vector<double>(1'000'000, 0));
}

TEST(Neighbours, OnePointHasNone) {
  EXPECT_EQ(meanNeighbourDistances({1, 2, 3}), std::vector<double>{0});
  EXPECT_TRUE(meanNeighbourDistances({}).empty());
}

TEST(Start, PointsBecomeRoundGaussians) {
  Capture C;
  C.Points.Positions = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1};
  C.Points.Colours = {255, 0, 51, 0, 0, 0, 9, 9, 9, 8, 8, 8};
  const Scene S = startingScene(C, {0, 2, 1000});
  ASSERT_EQ(S.size(), 4U);
  EXPECT_EQ(S.ShDegree, 2);
  EXPECT_EQ(S.Means, C.Points.local());
  EXPECT_NEAR(S.LogScales[1], 0, 1e-7); // three neighbours at 1
  EXPECT_NEAR(S.LogScales[4], std::log((1 + 2 * std::sqrt(2.0)) / 3), 1e-6);
  EXPECT_EQ(S.Quats[0], 1);
  EXPECT_EQ(S.Quats[1], 0);
  EXPECT_NEAR(activate<double>(S).Opacities[2], 0.1, 1e-7);
  for (const auto &[Channel, Value] :
       {std::pair(0U, 1.0), {1U, 0.0}, {2U, 0.2}})
    EXPECT_NEAR(0.5 + ShC0 * S.Sh[Channel], Value, 1e-6);
  EXPECT_EQ(S.Sh[3], 0);
}

TEST(Start, PointsAtOnePlaceHaveASize) {
  Capture C;
  C.Points.Positions.assign(15, 2);
  C.Points.Colours.assign(15, 100);
  const Scene S = startingScene(C, {0, 0, 1000});
  for (const float Log : S.LogScales)
    EXPECT_TRUE(std::isfinite(Log));
}

TEST(Start, RandomPointsFillTheirCubeTheSameEachTime) {
  const Capture C;
  const Scene A = startingScene(C, {7, 0, 3000});
  ASSERT_EQ(A.size(), 3000U);
  double Sum = 0;
  for (const float V : A.Means) {
    EXPECT_LT(std::abs(V), RandomReach);
    Sum += V;
  }
  EXPECT_NEAR(Sum / 9000, 0, 0.03);
  EXPECT_EQ(A.Means, startingScene(C, {7, 0, 3000}).Means);
  EXPECT_NE(A.Means, startingScene(C, {8, 0, 3000}).Means);
}

TEST(Start, TheLeastSizeFollowsTheUnitOfTheCapture) {
  Capture Large, Small;
  CaptureView V;
  V.Pose.Position = {4, 0, 0};
  Large.Views.push_back(V);
  V.Pose.Position = {1.0 / 64, 0, 0};
  Small.Views.push_back(V);
  for (Capture *C : {&Large, &Small}) {
    C->Points.Positions.assign(15, 0);
    C->Points.Colours.assign(15, 100);
  }
  EXPECT_NEAR(startingScene(Small, {0, 0, 9}).LogScales[0],
              startingScene(Large, {0, 0, 9}).LogScales[0] - std::log(64),
              1e-5);
}

TEST(Start, ViewsSeeTheMiddleOfRandomPointsOrNot) {
  Capture C;
  CaptureView V;
  V.Pose.Width = V.Pose.Height = 100;
  V.Pose.Fx = V.Pose.Fy = V.Pose.Cx = V.Pose.Cy = 50;
  for (std::size_t K = 0; K < 3; ++K)
    V.Pose.Rotation[K][K] = 1;
  for (const double X : {0.0, 1.9, 2.1}) {
    V.Pose.Position = {X, 0, -2};
    C.Views.push_back(V);
  }
  V.Pose.Position = {0, 0, 2}; // looks away
  C.Views.push_back(V);
  EXPECT_EQ(randomCube(C).SeenBy, 2U);
  EXPECT_EQ(randomCube(C).centreText(), "the origin");
}

/// \p Count pictures of 100x100 px on a circle of radius \p R about \p Centre,
/// which they look at.
Capture ringOf(const WorldPoint &Centre, double R, int Count = 8) {
  Capture C;
  for (int I = 0; I < Count; ++I) {
    const double Angle = 2 * std::numbers::pi * I / Count, S = std::sin(Angle),
                 K = std::cos(Angle);
    CaptureView V;
    V.Pose.Width = V.Pose.Height = 100;
    V.Pose.Fx = V.Pose.Fy = V.Pose.Cx = V.Pose.Cy = 50;
    V.Pose.Position = {Centre[0] - R * S, Centre[1], Centre[2] - R * K};
    V.Pose.Rotation = {{{K, 0, S}, {0, 1, 0}, {-S, 0, K}}};
    C.Views.push_back(V);
  }
  return C;
}

TEST(Start, RandomPointsFollowTheUnitAndThePlaceOfTheCapture) {
  for (const double Away : {0.0, 250.0, 1e6})
    for (const double R : {0.004, 4.0, 4000.0}) {
      const WorldPoint Centre{Away * R, -Away * R, Away * R / 3};
      Capture C = ringOf(Centre, R);
      const RandomCube Cube = randomCube(C);
      EXPECT_EQ(Cube.SeenBy, 8U);
      EXPECT_NEAR(Cube.Reach / R, RandomReach / 4, 0.03 * RandomReach) << R;
      for (std::size_t K = 0; K < 3; ++K)
        EXPECT_NEAR(Cube.Centre[K], Centre[K], 1e-2 * R) << R;
      C.Points.Origin = Cube.Centre;
      const Scene S = startingScene(C, {7, 0, 300});
      for (std::size_t I = 0; I < S.Means.size(); ++I)
        EXPECT_LT(std::abs(S.mean(I) - Cube.Centre[I % 3]), 1.001 * Cube.Reach);
    }
  // Of 2.83 to 5.66 units, as synthetic captures are, nothing changes.
  EXPECT_EQ(randomCube(ringOf({}, 3)).Reach, RandomReach);
  EXPECT_EQ(randomCube(ringOf({}, 5.5)).Reach, RandomReach);
}

TEST(Start, FewerThanThePointsAreSpreadOverThem) {
  Capture C;
  for (int I = 0; I < 90; ++I)
    C.Points.Positions.push_back(static_cast<float>(I / 3));
  C.Points.Colours.assign(90, 1);
  const Scene S = startingScene(C, {0, 0, 10});
  ASSERT_EQ(S.size(), 10U);
  EXPECT_EQ(S.Means[0], 0);
  EXPECT_EQ(S.Means[3], 3);
  EXPECT_EQ(S.Means[27], 27);
}

} // namespace
