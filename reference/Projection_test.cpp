#include "Projection.h"
#include "TestScenes.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::reference;

namespace {

Splat<double> projectOne(glm::dvec3 Mean, const Options &O,
                         const Camera<double> &C = frontCamera(64, 48, 50),
                         double Scale = 0.1, double Opacity = 0.8) {
  Gaussians<double> G;
  addRound(G, Mean, Scale, Opacity, {1, 1, 1});
  return project(G, 0, C, O);
}

TEST(Projection, AxialRoundGaussianIsARoundDisc) {
  const auto S = projectOne({0, 0, 2}, {});
  ASSERT_TRUE(S.Visible);
  EXPECT_EQ(S.Mean, glm::dvec2(32, 24));
  EXPECT_EQ(S.Depth, 2);
  const double Variance = 2.5 * 2.5 + 0.3; // (f s / z)^2 + dilation
  EXPECT_NEAR(S.Covariance[0], Variance, 1e-12);
  EXPECT_NEAR(S.Covariance[1], 0, 1e-12);
  EXPECT_NEAR(S.Covariance[2], Variance, 1e-12);
  EXPECT_NEAR(S.Conic[0], 1 / Variance, 1e-14);
  const double E = std::sqrt(2 * std::log(255 * 0.8) * Variance);
  EXPECT_NEAR(S.Extent.x, E, 1e-12);
  EXPECT_NEAR(S.Extent.y, E, 1e-12);
}

TEST(Projection, QuaternionTurnsTheAxes) {
  // A quarter turn about z takes the long x axis to y.
  Gaussians<double> G;
  addRound(G, {0, 0, 1}, 0.1, 0.8, {1, 1, 1});
  G.Scales[0] = {0.2, 0.1, 0.1};
  G.Quats[0] = {std::sqrt(0.5), 0, 0, std::sqrt(0.5)};
  const auto S = project(G, 0, frontCamera(64, 48, 50), Options{});
  EXPECT_NEAR(S.Covariance[0], 25 + 0.3, 1e-12);
  EXPECT_NEAR(S.Covariance[2], 100 + 0.3, 1e-12);
  // An eighth turn of it mixes them: off-diagonal (100 - 25) / 2.
  G.Quats[0] = {std::cos(M_PI / 8), 0, 0, std::sin(M_PI / 8)};
  EXPECT_NEAR(project(G, 0, frontCamera(64, 48, 50), Options{}).Covariance[1],
              37.5, 1e-12);
}

TEST(Projection, NearPlanesDiffer) {
  Options Inria, Gsplat;
  Gsplat.Rule = Rules::Gsplat;
  EXPECT_FALSE(projectOne({0, 0, 0.2}, Inria).Visible);
  EXPECT_TRUE(projectOne({0, 0, std::nextafter(0.2, 1)}, Inria).Visible);
  EXPECT_TRUE(projectOne({0, 0, 0.01}, Gsplat).Visible);
  EXPECT_FALSE(projectOne({0, 0, std::nextafter(0.01, 0)}, Gsplat).Visible);
  for (const Options &O : {Inria, Gsplat}) {
    EXPECT_FALSE(projectOne({0, 0, -1}, O).Visible);
    EXPECT_FALSE(projectOne({0, 0, std::nan("")}, O).Visible);
    EXPECT_FALSE(projectOne({std::nan(""), 0, 1}, O).Visible);
  }
}

/// S_xx of a round Gaussian of scale 1 at (x, 0, 1) whose slope in the Jacobian
/// is \p Slope: f^2 (1 + slope^2).
double varianceAt(double Focal, double Slope) {
  return Focal * Focal * (1 + Slope * Slope) + 0.3;
}

TEST(Projection, JacobianClampsDiffer) {
  auto C = frontCamera(64, 48, 40);
  C.Principal.x = 24; // off centre: 24 px to the left, 40 to the right
  Options Inria, Gsplat;
  Gsplat.Rule = Rules::Gsplat;
  const double Half = 32. / 40;
  const auto Expect = [&](double X, const Options &O, double Slope) {
    const auto S = projectOne({X, 0, 1}, O, C, 1);
    EXPECT_NEAR(S.Covariance[0], varianceAt(40, Slope), 1e-9) << X;
    EXPECT_NEAR(S.Mean.x, 40 * X + 24, 1e-12); // the mean is not clamped
  };
  Expect(0.5, Inria, 0.5);
  Expect(9, Inria, 1.3 * Half);
  Expect(-9, Inria, -1.3 * Half);
  Expect(0.5, Gsplat, 0.5);
  Expect(9, Gsplat, 40. / 40 + 0.3 * Half);
  Expect(-9, Gsplat, -24. / 40 - 0.3 * Half);
}

TEST(Projection, AntialiasingKeepsTheIntegral) {
  Options O;
  O.Antialiased = true;
  const auto S = projectOne({0, 0, 2}, O);
  EXPECT_NEAR(S.Compensation, 6.25 / 6.55, 1e-14);
  EXPECT_NEAR(S.Opacity, 0.8 * 6.25 / 6.55, 1e-14);
  // A speck: both rules hold the ratio under the root.
  O.Reach = Support::Box3;
  const auto Camera = frontCamera(64, 48, 50);
  for (const Rules Rule : {Rules::Inria, Rules::Gsplat}) {
    O.Rule = Rule;
    EXPECT_NEAR(projectOne({0, 0, 2}, O, Camera, 1e-6).Compensation, 0.005,
                1e-15);
  }
}

TEST(Projection, ExtentsFollowTheSupport) {
  Options O;
  const double Sigma = std::sqrt(6.55);
  O.Reach = Support::Box3;
  EXPECT_NEAR(projectOne({0, 0, 2}, O).Extent.x, 3 * Sigma, 1e-12);
  O.Reach = Support::Square3;
  // The eigenvalue of a round disc is taken sqrt(0.1) too large.
  const double R = std::ceil(3 * std::sqrt(6.55 + std::sqrt(0.1)));
  EXPECT_EQ(projectOne({0, 0, 2}, O).Extent, glm::dvec2(R));
  EXPECT_EQ(projectOne({0, 0, 2}, O).Radius, glm::ivec2(int(R)));
}

TEST(Projection, GsplatRadiusShrinksWithOpacity) {
  Options O;
  O.Rule = Rules::Gsplat;
  const auto Camera = frontCamera(64, 48, 50);
  const double Sigma = std::sqrt(6.55);
  EXPECT_EQ(projectOne({0, 0, 2}, O, Camera, 0.1, 1).Radius.x,
            std::ceil(std::sqrt(2 * std::log(255.)) * Sigma));
  EXPECT_EQ(projectOne({0, 0, 2}, O, Camera, 0.1, 0.01).Radius.y,
            std::ceil(std::sqrt(2 * std::log(2.55)) * Sigma));
}

TEST(Projection, TooFaintIsCulledWhereAlphaIsTheSupport) {
  Options O;
  const auto Camera = frontCamera(64, 48, 50);
  EXPECT_FALSE(projectOne({0, 0, 2}, O, Camera, 0.1, 0.0039).Visible);
  EXPECT_TRUE(projectOne({0, 0, 2}, O, Camera, 0.1, 0.0040).Visible);
  O.Reach = Support::Box3;
  EXPECT_TRUE(projectOne({0, 0, 2}, O, Camera, 0.1, 0.0039).Visible);
}

TEST(Projection, DegenerateIsCulled) {
  Options O;
  O.Dilation = 0;
  Gaussians<double> G;
  addRound(G, {0, 0, 1}, 0.1, 0.8, {1, 1, 1});
  EXPECT_TRUE(project(G, 0, frontCamera(64, 48, 50), O).Visible);
  G.Scales[0] = {0.1, 0, 0};
  EXPECT_FALSE(project(G, 0, frontCamera(64, 48, 50), O).Visible);
  G.Scales[0] = glm::dvec3(std::numeric_limits<double>::max());
  EXPECT_FALSE(project(G, 0, frontCamera(64, 48, 50), O).Visible);
}

TEST(Projection, ANeedleKeepsItsShortAxisInSinglePrecision) {
  // 300 px by less than one, diagonal: S_xx S_yy - S_xy^2 in fp32 would be off
  // by several per cent here.
  Gaussians<double> G;
  addRound(G, {0.1, 0.2, 1}, 1, 0.8, {1, 1, 1});
  G.Scales[0] = {6, 1e-4, 1e-4};
  G.Quats[0] = {std::cos(0.4), 0, 0, std::sin(0.4)};
  const auto C = frontCamera(64, 48, 50);
  Gaussians<float> F;
  F.Means = {glm::vec3(G.Means[0])};
  F.Scales = {glm::vec3(G.Scales[0])};
  F.Quats = {glm::vec4(G.Quats[0])};
  F.Opacities = {0.8F};
  F.Colors = {glm::vec3(1)};
  const Camera<float> Cf{64,       48,       glm::mat3(1), {}, {},
                         {50, 50}, {32, 24}, {},           0};
  const auto D = project(G, 0, C, Options{});
  const auto S = project(F, 0, Cf, Options{});
  for (int K = 0; K < 3; ++K)
    EXPECT_NEAR(S.Conic[K] / D.Conic[K], 1, 1e-5) << K;
}

} // namespace
