// Each camera model by its own formula, by OpenCV's figures where it has them,
// and by differences.

#include "Lens.h"
#include "Projection.h"
#include "TestScenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::reference;

namespace {

using Coefficients = LensCoefficients;

// k1, k2, p1, p2, k3, k4, k5, k6, s1 to s4.
constexpr Coefficients Barrel{-0.28, 0.09,  0.002, -0.003, -0.012, 0.03,
                              0.02,  0.001, 0.004, -0.001, 0.002,  0.0005};
constexpr Coefficients Equidistant{0.05, -0.01, 0.004, -0.0008};
constexpr Coefficients Unified{0.6, 1.2};

Camera<double> camera(const LensModel *Model, const Coefficients &K = {}) {
  auto C = frontCamera(64, 48, 40);
  C.Focal.y = 42;
  C.Principal = {30, 25};
  if (Model == &lenses::Equirectangular) {
    C.Focal = {64 / (2 * M_PI), 48 / M_PI};
    C.Principal = {32, 24};
  }
  setLens(C, *Model, K);
  return C;
}

const Coefficients &coefficientsOf(const LensModel *M) {
  if (M == &lenses::Eucm)
    return Unified;
  return M == &lenses::Fisheye ? Equidistant : Barrel;
}

glm::dvec2 placeOf(const Camera<double> &C, const glm::dvec3 &P) {
  glm::dvec2 At;
  EXPECT_TRUE(placeThrough(C.Optics, P, At));
  return C.Focal * At + C.Principal;
}

TEST(Lens, PlacesAreThoseOfOpenCv) {
  // cv2.projectPoints and cv2.fisheye.projectPoints of OpenCV 4.6.0 for these
  // points, with the camera's matrix and coefficients.
  const glm::dvec3 Points[] = {
      {0.3, -0.2, 1.5}, {-0.4, 0.5, 1}, {0.8, 0.1, 1.2}};
  const glm::dvec2 Distorted[] = {{37.847125572277, 19.518313175949},
                                  {15.770138415972, 43.761803179036},
                                  {53.254632916365, 28.130982600076}};
  const glm::dvec2 Fish[] = {{37.872662577910, 19.489136195463},
                             {15.550921937812, 43.964414956621},
                             {53.866566245214, 28.132486819684}};
  for (std::size_t I = 0; I < 3; ++I) {
    const auto A = placeOf(camera(&lenses::OpenCv, Barrel), Points[I]);
    const auto B = placeOf(camera(&lenses::Fisheye, Equidistant), Points[I]);
    for (int K = 0; K < 2; ++K) {
      EXPECT_NEAR(A[K], Distorted[I][K], 1e-9) << I;
      EXPECT_NEAR(B[K], Fish[I][K], 1e-9) << I;
    }
  }
}

TEST(Lens, TheSphereGoesRound) {
  const auto C = camera(&lenses::Equirectangular);
  const auto Expect = [&](glm::dvec3 P, double X, double Y) {
    EXPECT_NEAR(placeOf(C, P).x, X, 1e-12);
    EXPECT_NEAR(placeOf(C, P).y, Y, 1e-12);
  };
  Expect({0, 0, 2}, 32, 24);  // ahead: the middle
  Expect({3, 0, 0}, 48, 24);  // right
  Expect({-3, 0, 0}, 16, 24); // left
  Expect({1e-9, 0, -1}, 64 - 32e-9 / M_PI, 24);
  Expect({-1e-9, 0, -1}, 32e-9 / M_PI, 24);
  Expect({0, 1, 1}, 32, 36); // 45 degrees down
  Expect({0, -1, 0}, 32, 0); // straight up
}

TEST(Lens, AnOrthographicCameraDoesNotShrink) {
  const auto C = camera(&lenses::Orthographic);
  EXPECT_EQ(placeOf(C, {0.5, -0.25, 1}), placeOf(C, {0.5, -0.25, 100}));
  EXPECT_EQ(placeOf(C, {0.5, -0.25, 1}), glm::dvec2(50, 14.5));
}

// Where 1 + 3 k1 r^2 is 0, and where 1 + 3 k1 t^2 + 5 k2 t^4 is.
TEST(Lens, LimitsAreWhereTheModelTurnsBack) {
  EXPECT_NEAR(camera(&lenses::OpenCv, {-0.3}).Optics.Limit, std::sqrt(1 / 0.9),
              1e-9);
  EXPECT_EQ(camera(&lenses::OpenCv, {0.3}).Optics.Limit,
            std::numeric_limits<double>::infinity());
  // 1 + 9 r8 r^8
  EXPECT_NEAR(
      camera(&lenses::OpenCv, {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, -0.01})
          .Optics.Limit,
      std::pow(1 / 0.09, 1. / 8), 1e-9);
  // A pole of the denominator before that: 1 + k4 r^2.
  EXPECT_NEAR(camera(&lenses::OpenCv, {0, 0, 0, 0, 0, -4.}).Optics.Limit, 0.5,
              1e-9);
  EXPECT_NEAR(camera(&lenses::Fisheye, {-0.1}).Optics.Limit, std::sqrt(1 / 0.3),
              1e-9);
  EXPECT_EQ(camera(&lenses::Fisheye).Optics.Limit, M_PI);
  glm::dvec2 At;
  const auto Fold = camera(&lenses::OpenCv, {-0.3});
  EXPECT_TRUE(placeThrough(Fold.Optics, glm::dvec3(1.05, 0, 1), At));
  EXPECT_FALSE(placeThrough(Fold.Optics, glm::dvec3(1.06, 0, 1), At));
  EXPECT_FALSE(placeThrough(Fold.Optics, glm::dvec3(0.1, 0, -1), At));
  const auto Fish = camera(&lenses::Fisheye, {-0.1});
  EXPECT_TRUE(placeThrough(Fish.Optics, glm::dvec3(1, 0, -0.259), At));
  EXPECT_FALSE(placeThrough(Fish.Optics, glm::dvec3(1, 0, -0.262), At));
}

TEST(Lens, WithoutCoefficientsItIsAPinhole) {
  Gaussians<double> G = randomGaussians(40, 3);
  for (const Rules Rule : {Rules::Inria, Rules::Gsplat}) {
    Options O;
    O.Rule = Rule;
    auto Pinhole = camera(&lenses::OpenCv);
    Pinhole.Optics = {};
    const auto Straight = project(G, Pinhole, O);
    const auto Through = project(G, camera(&lenses::OpenCv), O);
    for (std::size_t I = 0; I < G.size(); ++I) {
      ASSERT_EQ(Straight[I].Visible, Through[I].Visible) << I;
      if (!Straight[I].Visible)
        continue;
      EXPECT_NEAR(Straight[I].Mean.x, Through[I].Mean.x, 1e-9);
      // INRIA's limits have the picture's middle for their own.
      for (int K = 0; K < 3; ++K)
        EXPECT_NEAR(Straight[I].Covariance[K] / Through[I].Covariance[K], 1,
                    1e-9);
    }
  }
}

TEST(Lens, RowsAreTheDerivative) {
  constexpr double Step = 1e-6;
  for (const LensModel *M : lenses::all()) {
    const auto C = camera(M, coefficientsOf(M));
    for (const glm::dvec3 P :
         {glm::dvec3(0.3, -0.2, 1.5), glm::dvec3(-0.4, 0.5, 1),
          glm::dvec3(1e-5, 1e-6, 2), glm::dvec3(0.02, 0.1, 0.8)}) {
      const auto Rows = rowsThrough(C, P, Rules::Gsplat);
      for (int K = 0; K < 3; ++K) {
        glm::dvec3 High = P, Low = P;
        High[K] += Step;
        Low[K] -= Step;
        const glm::dvec2 D = (placeOf(C, High) - placeOf(C, Low)) / (2 * Step);
        EXPECT_NEAR(Rows.X[K], D.x, 1e-6) << M->Name << K;
        EXPECT_NEAR(Rows.Y[K], D.y, 1e-6) << M->Name << K;
      }
    }
  }
}

TEST(Lens, TheWayBackIsTheDerivativeOfRowsToo) {
  constexpr double Step = 1e-6;
  const LensRows<double> By{{0.7, -0.3, 0.4}, {-0.5, 0.9, 0.2}};
  const glm::dvec2 ByPlace(0.3, -0.8);
  for (const LensModel *M : lenses::all())
    for (const Rules Rule : {Rules::Inria, Rules::Gsplat}) {
      const auto C = camera(M, coefficientsOf(M));
      const auto Value = [&](const glm::dvec3 &P) {
        const auto R = rowsThrough(C, P, Rule);
        return glm::dot(R.X, By.X) + glm::dot(R.Y, By.Y) +
               glm::dot(placeOf(C, P), ByPlace);
      };
      // On the axis, aside, beyond the limits of slopes, near a pole.
      for (const glm::dvec3 P :
           {glm::dvec3(0, 0, 1.5), glm::dvec3(1e-6, 2e-6, 1.5),
            glm::dvec3(-0.4, 0.5, 1), glm::dvec3(1.25, 0.2, 1),
            glm::dvec3(0.01, 1.2, 0.02)}) {
        glm::dvec2 At;
        if (!placeThrough(C.Optics, P, At))
          continue;
        const auto Got = backThrough(C, P, Rule, ByPlace, By);
        for (int K = 0; K < 3; ++K) {
          glm::dvec3 High = P, Low = P;
          High[K] += Step;
          Low[K] -= Step;
          const double Want = (Value(High) - Value(Low)) / (2 * Step);
          EXPECT_NEAR(Got[K], Want, 1e-6 * std::max(1., std::abs(Want)))
              << M->Name << " " << int(Rule) << " " << P.x << " " << K;
        }
      }
    }
}

// Of a linear camera seven points and the Jacobian say the same; of others, the
// smaller the Gaussian the more so.
TEST(Lens, SevenPointsAgreeWithTheJacobian) {
  Gaussians<double> G;
  addRound(G, {0.3, -0.2, 1.5}, 0.1, 0.8, {1, 1, 1});
  G.Scales[0] = {0.1, 0.03, 0.2};
  G.Quats[0] = {std::cos(0.4), 0, std::sin(0.4), 0};
  for (const LensModel *M : lenses::all()) {
    const auto C = camera(M, coefficientsOf(M));
    Options Local, Points;
    Local.Dilation = Points.Dilation = 0;
    Points.Through = Spread::Unscented;
    double Before = 0;
    for (const double Size : {1., 0.1, 0.01}) {
      Gaussians<double> Small = G;
      Small.Scales[0] *= Size;
      const auto A = project(Small, 0, C, Local);
      const auto B = project(Small, 0, C, Points);
      ASSERT_TRUE(A.Visible && B.Visible);
      const double Off = std::abs(A.Covariance[0] / B.Covariance[0] - 1);
      if (M == &lenses::Orthographic) {
        EXPECT_LT(Off, 1e-12);
      } else if (Before > 0) {
        EXPECT_LT(Off, Before / 50); // of second order
      } else {
        EXPECT_GT(Off, 1e-4);
      }
      Before = Off;
    }
  }
}

TEST(Lens, WhatCrossesTheSeamStandsOnBothSides) {
  Gaussians<double> G;
  addRound(G, {0.01, 0, -2}, 0.2, 0.8, {1, 1, 1});
  const auto C = camera(&lenses::Equirectangular);
  const auto S = project(G, C, Options{});
  ASSERT_EQ(S.size(), 3U);
  EXPECT_NEAR(S[0].Mean.x, 63.95, 0.01);
  EXPECT_NEAR(S[1].Mean.x, 127.95, 0.01);
  EXPECT_NEAR(S[2].Mean.x, -0.05, 0.01);
  EXPECT_EQ(S[0].Depth, S[2].Depth);
}

TEST(Lens, AFisheyeSeesWhatIsBeside) {
  Gaussians<double> G;
  addRound(G, {2, 0, -0.1}, 0.1, 0.8, {1, 1, 1});
  const auto S = project(G, 0, camera(&lenses::Fisheye), Options{});
  ASSERT_TRUE(S.Visible);
  EXPECT_NEAR(S.Mean.x, 30 + 40 * (M_PI / 2 + std::atan(0.05)), 1e-9);
  EXPECT_NEAR(S.Depth, std::sqrt(4.01), 1e-12); // not z, which is below 0
}

} // namespace
