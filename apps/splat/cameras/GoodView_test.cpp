#include "cameras/GoodView.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>

using namespace vorion::splat;

namespace {

void add(Scene &S, const Vector &Mean, const Vector &LogScale,
         float Opacity = 4) {
  for (std::size_t A = 0; A < 3; ++A) {
    S.Means.push_back(static_cast<float>(Mean[A]));
    S.LogScales.push_back(static_cast<float>(LogScale[A]));
    S.Sh.push_back(0);
  }
  S.Quats.insert(S.Quats.end(), {1, 0, 0, 0});
  S.OpacityLogits.push_back(Opacity);
}

/// A floor of flat Gaussians about \p Centre in the plane across axis \p Up,
/// and a heap on it; strays far away.
Scene heapOnFloor(const Vector &Centre, std::size_t Up, double Sign) {
  std::mt19937 Random(3);
  const auto Unit = [&] { return double(Random() >> 8) / (1 << 24) * 2 - 1; };
  Scene S;
  for (int I = 0; I < 2000; ++I) {
    Vector P = {Unit(), Unit(), Unit()};
    P[Up] = -0.02 * Sign;
    Vector Flat{-3, -3, -3};
    Flat[Up] = -8;
    add(S, Centre + P, Flat);
    Vector Q = {0.3 * Unit(), 0.3 * Unit(), 0.3 * Unit()};
    Q[Up] = Sign * 0.3 * std::abs(Q[Up]);
    add(S, Centre + Q, {-5, -5, -5});
  }
  for (int I = 0; I < 100; ++I)
    add(S, {300 * Unit(), 300 * Unit(), 300 * Unit()}, {1, 1, 1}, 0);
  return S;
}

TEST(GoodView, StraysDoNotMoveTheFocus) {
  const Vector Centre{7, -5, 2};
  const SceneFocus F = focusOf(heapOnFloor(Centre, 1, -1));
  EXPECT_LT(length(F.Centre - Centre), 0.2);
  EXPECT_GT(F.Radius, 0.3);
  EXPECT_LT(F.Radius, 2);
}

TEST(GoodView, UpIsAcrossTheFloor) {
  for (const std::size_t Axis : {1U, 2U})
    for (const double Sign : {-1.0, 1.0})
      EXPECT_GT(Sign * focusOf(heapOnFloor({}, Axis, Sign)).Up[Axis], 0.99)
          << Axis << Sign;
  // Unless the user says so.
  EXPECT_EQ(focusOf(heapOnFloor({}, 1, -1), Vector{0, 0, -1}).Up,
            (Vector{0, 0, -1}));
}

/// A standing figure: a column of Gaussians that are flat to the front.
Scene figure(std::size_t Up, double Sign) {
  std::mt19937 Random(5);
  const auto Unit = [&] { return double(Random() >> 8) / (1 << 24) * 2 - 1; };
  Scene S;
  for (int I = 0; I < 3000; ++I) {
    Vector P = {0.3 * Unit(), 0.3 * Unit(), 0.3 * Unit()};
    P[Up] = Sign * 0.9 * (1 + Unit());
    Vector Flat{-4, -4, -4};
    Flat[Up == 2 ? 1 : 2] = -8;
    add(S, P, Flat);
  }
  return S;
}

TEST(GoodView, ATallSceneStands) {
  EXPECT_EQ(focusOf(figure(1, -1)).Up, (Vector{0, -1, 0}));
  EXPECT_EQ(focusOf(figure(2, 1)).Up, (Vector{0, 0, 1}));
}

TEST(GoodView, UpIsNearWhatTheFileStates) {
  SceneFile F;
  F.Gaussians = figure(1, 1);
  for (const Vector &Stated : {Vector{0, 1, 0}, Vector{0, 0, 1}}) {
    F.Up = Stated;
    EXPECT_GT(dot(focusOf(F).Up, Stated), 0.85);
  }
  EXPECT_EQ(focusOf(F, Vector{1, 0, 0}).Up, (Vector{1, 0, 0}));
}

TEST(GoodView, ASceneWithoutBackgroundIsInThePictureAsAWhole) {
  for (const double Scale : {1.0, 1e-3}) {
    Scene S = figure(1, -1);
    for (float &M : S.Means)
      M *= static_cast<float>(Scale);
    for (float &L : S.LogScales)
      L += static_cast<float>(std::log(Scale));
    for (const auto &[Width, Height] : {std::pair(320, 180), {90, 200}}) {
      const Camera C = goodView(S, focusOf(S), Width, Height, 0.2);
      const auto R = C.worldToCameraRotation();
      const auto T = C.worldToCameraTranslation();
      double Reach = 0;
      for (std::size_t I = 0; I < S.size(); ++I) {
        Vector P{};
        for (std::size_t A = 0; A < 3; ++A)
          P[A] = R[3 * A] * S.Means[3 * I] + R[3 * A + 1] * S.Means[3 * I + 1] +
                 R[3 * A + 2] * S.Means[3 * I + 2] + T[A];
        ASSERT_GT(P[2], 0.2);
        Reach = std::max({Reach, std::abs(2 * C.Fx * P[0] / P[2] / Width),
                          std::abs(2 * C.Fy * P[1] / P[2] / Height)});
      }
      EXPECT_LT(Reach, 0.97);
      EXPECT_GT(Reach, 0.6);
    }
  }
}

TEST(GoodView, ItLooksAtTheFocusFromAboveTheFloor) {
  const Vector Centre{7, -5, 2};
  const Scene S = heapOnFloor(Centre, 1, -1);
  const Camera C = goodView(S, focusOf(S), 320, 180, 0.2);
  EXPECT_TRUE(isRotation(C.Rotation));
  EXPECT_LT(C.Position[1], Centre[1]);
  const Vector To = unit(Centre - C.Position);
  EXPECT_GT(To[0] * C.Rotation[0][2] + To[1] * C.Rotation[1][2] +
                To[2] * C.Rotation[2][2],
            0.98);
  EXPECT_EQ(C, goodView(S, focusOf(S), 320, 180, 0.2));
}

TEST(GoodView, ASmallSceneIsAsLargeInThePictureAndBeyondTheNearPlane) {
  const Scene S = heapOnFloor({}, 1, -1);
  const Camera Usual = goodView(S, focusOf(S), 320, 180, 0.2);
  Scene Small = S;
  for (float &M : Small.Means)
    M *= 1e-3F;
  for (float &L : Small.LogScales)
    L += std::log(1e-3F);
  const SceneFocus F = focusOf(Small);
  const Camera C = goodView(Small, F, 320, 180, 0.2);
  const double Away = length(F.Centre - C.Position);
  EXPECT_GE(Away, (0.2 + F.Radius) * (1 - 1e-12));
  const double Size = C.Fx / Away * 1e-3,
               UsualSize =
                   Usual.Fx / length(focusOf(S).Centre - Usual.Position);
  EXPECT_GT(Size, 0.5 * UsualSize);
  EXPECT_LT(Size, 3 * UsualSize);
}

TEST(GoodView, AnythingFiniteHasAView) {
  Scene One;
  add(One, {1e6, 0, 0}, {-90, -90, -90}, -30);
  Scene Wide;
  add(Wide, {1e30, -1e30, 0}, {80, 80, 80});
  add(Wide, {-1e30, 1e30, 5}, {-80, 0, 80});
  Wide.Quats = {0, 0, 0, 0, 1, 1, 1, 1};
  for (const Scene *S : {&One, &Wide}) {
    const Camera C = goodView(*S, focusOf(*S), 64, 64, 0.2);
    EXPECT_TRUE(isRotation(C.Rotation));
    for (const double V : C.Position)
      EXPECT_TRUE(std::isfinite(V));
  }
}

} // namespace
