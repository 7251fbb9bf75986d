// The unscented transform by what it approximates: pictures in which a pixel
// sees of each Gaussian the largest density on its ray.

#include "AlongRays.h"
#include "Lens.h"
#include "Projection.h"
#include "TestScenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

constexpr int Width = 60, Height = 40;

/// The mean square difference of the picture that \p Through draws from that.
double difference(const Gaussians<double> &G, const Camera<double> &C,
                  Spread Through) {
  Options O;
  O.Through = Through;
  O.Dilation = 0;
  O.Cutoff = 0;
  const auto Drawn = render(G, C, O), Seen = renderAlongRays(G, C, O);
  double Squares = 0;
  for (std::size_t I = 0; I < Drawn.Render.size(); ++I) {
    const glm::dvec3 Off = Drawn.Render[I] - Seen.Render[I];
    Squares += glm::dot(Off, Off);
  }
  return Squares / (3. * C.Width * C.Height);
}

double decibels(double Squares) { return -10 * std::log10(Squares); }

Camera<double> camera(const LensModel *M, double Focal) {
  auto C = frontCamera(Width, Height, Focal);
  if (M == &lenses::Equirectangular)
    C.Focal = {Width / (2 * M_PI), Height / M_PI};
  setLens(C, *M, {});
  return C;
}

/// Small ones in the picture, and \p Others.
Gaussians<double> sceneWith(const std::vector<glm::dvec4> &Others) {
  Gaussians<double> G;
  for (int I = 0; I < 12; ++I)
    addRound(G, {std::sin(1.7 * I), 0.6 * std::cos(2.3 * I), 2.5 + 0.1 * I},
             0.15, 0.7, {0.5 + 0.5 * std::sin(I), 0.5, 0.2});
  for (const glm::dvec4 &O : Others)
    addRound(G, glm::dvec3(O), O.w, 0.9, {0.1, 0.3, 0.9});
  return G;
}

/// Places and sizes of large Gaussians. One point of each is just in front of
/// the near plane and far beside the picture.
const std::vector<glm::dvec4> BesidePinhole{
    {3, 0.3, 1.2, 0.55}, {-4, -1, 1.5, 0.72}, {0.5, -5, 1.6, 0.75}};

TEST(Unscented, WhatIsBesideAPinholeDoesNotCoverThePicture) {
  for (const double Focal : {20., 40., 300.}) {
    const auto C = camera(&lenses::Pinhole, Focal);
    const auto G = sceneWith(BesidePinhole);
    const double Points = decibels(difference(G, C, Spread::Unscented));
    EXPECT_GT(Points, 23) << Focal;
    EXPECT_GT(Points, decibels(difference(G, C, Spread::Jacobian)) - 0.5)
        << Focal;
  }
}

TEST(Unscented, WhatIsAroundACameraDoesNotCoverThePicture) {
  const std::vector<glm::dvec4> Others{
      {0.9, 0.2, -0.5, 0.5}, {-0.3, -1.1, -0.2, 0.6}, {0.2, 1, 0.3, 0.5}};
  for (const auto M : {&lenses::Fisheye, &lenses::Equirectangular}) {
    const auto C = camera(M, 18);
    const auto G = sceneWith(Others);
    EXPECT_GT(decibels(difference(G, C, Spread::Unscented)),
              decibels(difference(G, C, Spread::Jacobian)) - 0.5);
  }
}

TEST(Unscented, LargeGaussiansInViewAreBetterThanByTheJacobian) {
  const auto C = camera(&lenses::Pinhole, 25);
  const auto G = sceneWith(
      {{0.8, 0.3, 1.6, 0.3}, {-1, -0.4, 1.8, 0.35}, {-0.2, 0.9, 1.9, 0.35}});
  EXPECT_GT(decibels(difference(G, C, Spread::Unscented)),
            decibels(difference(G, C, Spread::Jacobian)) + 1);
}

TEST(Unscented, TheSpreadOfPointsDecidesWhoIsProjectedByThem) {
  const auto C = camera(&lenses::Pinhole, 40);
  Gaussians<double> G;
  // Points lie sqrt(3) 0.3 / 2 = 0.26 focal lengths beside the mean.
  addRound(G, {0, 0, 2}, 0.3, 0.9, {1, 1, 1});
  Options O;
  EXPECT_FALSE(project(G, 0, C, O).ByPoints);
  O.Through = Spread::Unscented;
  EXPECT_TRUE(project(G, 0, C, O).ByPoints);
  O.PointSpread = 0.25;
  EXPECT_FALSE(project(G, 0, C, O).ByPoints);
  O.PointSpread = 0.27;
  EXPECT_TRUE(project(G, 0, C, O).ByPoints);
}

} // namespace
