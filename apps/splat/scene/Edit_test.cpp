#include "scene/Axes.h"
#include "scene/Edit.h"
#include "scene/testing/SceneWriters.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Vec3 = std::array<double, 3>;
using Mat3 = std::array<Vec3, 3>;

Vec3 times(const Mat3 &M, const Vec3 &V) {
  Vec3 R{};
  for (std::size_t A = 0; A < 3; ++A)
    for (std::size_t B = 0; B < 3; ++B)
      R[A] += M[A][B] * V[B];
  return R;
}

/// Rows of the rotation of a quaternion of any norm.
Mat3 matrixOf(const float *Q) {
  const double N = std::sqrt(double(Q[0]) * Q[0] + double(Q[1]) * Q[1] +
                             double(Q[2]) * Q[2] + double(Q[3]) * Q[3]);
  const double W = Q[0] / N, X = Q[1] / N, Y = Q[2] / N, Z = Q[3] / N;
  return {
      {{1 - 2 * (Y * Y + Z * Z), 2 * (X * Y - W * Z), 2 * (X * Z + W * Y)},
       {2 * (X * Y + W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z - W * X)},
       {2 * (X * Z - W * Y), 2 * (Y * Z + W * X), 1 - 2 * (X * X + Y * Y)}}};
}

/// Colour of the first channel of Gaussian \p I from direction \p D, by the
/// numbers that INRIA's renderer has.
double colorOf(const Scene &S, std::size_t I, const Vec3 &D) {
  const auto [X, Y, Z] = D;
  const double Basis[16] = {
      0.28209479177387814,
      -0.4886025119029199 * Y,
      0.4886025119029199 * Z,
      -0.4886025119029199 * X,
      1.0925484305920792 * X * Y,
      -1.0925484305920792 * Y * Z,
      0.31539156525252005 * (2 * Z * Z - X * X - Y * Y),
      -1.0925484305920792 * X * Z,
      0.5462742152960396 * (X * X - Y * Y),
      -0.5900435899266435 * Y * (3 * X * X - Y * Y),
      2.890611442640554 * X * Y * Z,
      -0.4570457994644658 * Y * (4 * Z * Z - X * X - Y * Y),
      0.3731763325901154 * Z * (2 * Z * Z - 3 * X * X - 3 * Y * Y),
      -0.4570457994644658 * X * (4 * Z * Z - X * X - Y * Y),
      1.445305721320277 * Z * (X * X - Y * Y),
      -0.5900435899266435 * X * (X * X - 3 * Y * Y)};
  double Sum = 0;
  for (std::size_t K = 0; K < S.coefficients(); ++K)
    Sum += Basis[K] * S.Sh[3 * (S.coefficients() * I + K)];
  return Sum;
}

/// Far away, where fp32 holds no more than halves.
TEST(Edit, AMoveBackFromFarAwayIsRoundedOnce) {
  const Scene Home = randomScene(9, 1, 3);
  Scene There = Home;
  transform(There, {2, rotationOf({0, 90, 0}), {412345, 5654321, 120}});
  EXPECT_NE(There.MeanRests, std::vector<double>());
  Scene Both = There;
  join(Both, Home); // which has no rests
  changeAxes(Both, {.From = {1, 1, 1}, .To = {1, -1, -1}});
  changeAxes(Both, {.From = {1, -1, -1}, .To = {1, 1, 1}});
  EXPECT_EQ(keepOnly(Both, [](std::size_t I) { return I % 2 == 0; }), 9U);
  for (std::size_t I = 0; I < 27; ++I) {
    const std::size_t From = I / 3 * 2;
    EXPECT_EQ(Both.mean(I), From < 9
                                ? There.mean(3 * From + I % 3)
                                : double{Home.Means[3 * (From - 9) + I % 3]});
  }
  transform(There, {.Translation = {-412345, -5654321, -120}});
  transform(There, {0.5, rotationOf({0, -90, 0}), {}});
  for (std::size_t I = 0; I < Home.Means.size(); ++I)
    EXPECT_NEAR(There.Means[I], Home.Means[I],
                1e-9 + std::abs(Home.Means[I]) * 0x1p-24);
}

TEST(Edit, AMovedSceneLooksTheSameFromTheMovedPlace) {
  for (const int Degree : {0, 1, 2, 3})
    for (const Vec3 &Angles :
         {Vec3{90, 0, 0}, Vec3{0, 180, 0}, Vec3{20, -75, 143}}) {
      const Scene Before = randomScene(8, Degree, 5);
      Scene After = Before;
      const Similarity By{2.5, rotationOf(Angles), {3, -4, 5}};
      transform(After, By);
      for (std::size_t I = 0; I < Before.size(); ++I) {
        const Vec3 Mean = {Before.Means[3 * I], Before.Means[3 * I + 1],
                           Before.Means[3 * I + 2]};
        const Vec3 Moved = times(By.Rotation, Mean);
        const Mat3 Old = matrixOf(&Before.Quats[4 * I]),
                   New = matrixOf(&After.Quats[4 * I]);
        for (std::size_t A = 0; A < 3; ++A) {
          EXPECT_NEAR(After.Means[3 * I + A],
                      2.5 * Moved[A] + By.Translation[A], 2e-5);
          EXPECT_NEAR(After.LogScales[3 * I + A],
                      Before.LogScales[3 * I + A] + std::log(2.5), 1e-6);
          const Vec3 Axis =
              times(By.Rotation, {Old[0][A], Old[1][A], Old[2][A]});
          for (std::size_t B = 0; B < 3; ++B)
            EXPECT_NEAR(New[B][A], Axis[B], 1e-6);
        }
        for (const Vec3 &D :
             {Vec3{0.36, -0.48, 0.8}, Vec3{0, 0, -1}, Vec3{-0.6, 0.64, -0.48}})
          EXPECT_NEAR(colorOf(After, I, times(By.Rotation, D)),
                      colorOf(Before, I, D), 2e-6);
      }
    }
}

TEST(Edit, RotationsGoAboutXThenYThenZ) {
  // x to z by y (a quarter turn takes x to -z), and z stays by z.
  EXPECT_EQ(times(rotationOf({0, 90, 90}), {1, 0, 0}), (Vec3{0, 0, -1}));
  // y to z by x, then z to x by y.
  EXPECT_EQ(times(rotationOf({90, 90, 0}), {0, 1, 0}), (Vec3{1, 0, 0}));
  EXPECT_EQ(rotationOf({0, 0, -450}), rotationOf({0, 0, 270}));
  EXPECT_NEAR(rotationOf({0, 0, 30})[0][0], std::sqrt(0.75), 1e-15);
}

TEST(Edit, NothingChangesWithoutAMove) {
  const Scene Before = randomScene(8, 2, 5);
  Scene After = Before;
  transform(After, {});
  transform(After, {1, rotationOf({0, 360, 0}), {}});
  EXPECT_EQ(After.Quats, Before.Quats);
  EXPECT_EQ(After.Sh, Before.Sh);
  transform(After, {1, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 0, 0}});
  EXPECT_EQ(After.Quats, Before.Quats);
  EXPECT_EQ(After.Sh, Before.Sh);
  EXPECT_EQ(After.Means[0], Before.Means[0] + 1);
}

TEST(Edit, WhatIsKeptKeepsItsOrderAndValues) {
  const Scene Before = numberedScene(7, 1);
  Scene After = Before;
  EXPECT_EQ(keepOnly(After, [](std::size_t I) { return I % 3 == 1; }), 5U);
  ASSERT_EQ(After.size(), 2U);
  Scene Wanted;
  Wanted.ShDegree = 1;
  append(Wanted, Before, 1, 1);
  append(Wanted, Before, 4, 1);
  EXPECT_EQ(After.Means, Wanted.Means);
  EXPECT_EQ(After.LogScales, Wanted.LogScales);
  EXPECT_EQ(After.Quats, Wanted.Quats);
  EXPECT_EQ(After.OpacityLogits, Wanted.OpacityLogits);
  EXPECT_EQ(After.Sh, Wanted.Sh);
}

TEST(Edit, DegreesAreCutAndFilledWithZeros) {
  const Scene Before = numberedScene(3, 2);
  Scene S = Before;
  setShDegree(S, 3);
  EXPECT_EQ(S.Sh.size(), 3U * 48);
  EXPECT_EQ(S.Sh[48 + 26], Before.Sh[27 + 26]);
  EXPECT_EQ(S.Sh[48 + 27], 0);
  setShDegree(S, 2);
  EXPECT_EQ(S.Sh, Before.Sh);
  setShDegree(S, 0);
  EXPECT_EQ(S.Sh.size(), 9U);
  EXPECT_EQ(S.Sh[3], Before.Sh[27]);
}

TEST(Edit, JoinedScenesHaveTheLargerDegree) {
  Scene S = numberedScene(2, 1);
  const Scene Other = numberedScene(3, 3);
  join(S, Other);
  EXPECT_EQ(S.size(), 5U);
  EXPECT_EQ(S.ShDegree, 3);
  EXPECT_EQ(S.Sh[12], 0);
  EXPECT_EQ(S.Sh[2 * 48], Other.Sh[0]);
  EXPECT_EQ(S.Means[6], Other.Means[0]);
}

} // namespace
