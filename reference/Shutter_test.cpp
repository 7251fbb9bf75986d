// Rolling shutters by what they mean: differences of places, and pictures of
// which each row is drawn from where the camera is then.

#include "AlongRays.h"
#include "Footprint.h"
#include "Shutter.h"
#include "TestScenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

Camera<double> moving(const LensModel *Model) {
  auto C = frontCamera(64, 48, Model == &lenses::Fisheye ? 25 : 50);
  setLens(C, *Model, {-0.05, 0.01});
  C.Shutter = {-0.1, 0.15, 1.1, {0.3, -0.2, 0.1}, {0.15, -0.1, 0.2}};
  return C;
}

/// R(Turn * Part) of the definition, by many small steps.
glm::dvec3 turnedBySteps(const glm::dvec3 &Turn, double Part, glm::dvec3 V) {
  constexpr int Steps = 20000;
  const glm::dvec3 Step = Turn * (Part / Steps);
  for (int I = 0; I < Steps; ++I) {
    const glm::dvec3 Half = V + 0.5 * glm::cross(Step, V);
    V += glm::cross(Step, Half);
  }
  return V;
}

TEST(Shutter, APointIsSeenFromWhereTheCameraIsAtItsMoment) {
  for (const LensModel *M :
       {&lenses::Pinhole, &lenses::OpenCv, &lenses::Fisheye}) {
    const auto C = moving(M);
    for (const glm::dvec3 P :
         {glm::dvec3(0.3, -0.2, 1.5), {-0.5, 0.4, 1.2}, {0.1, 0.6, 2.}}) {
      ExposedPoint E;
      ASSERT_TRUE(expose(C, P, Rules::Gsplat, E));
      const glm::dvec2 At = C.Focal * E.Place + C.Principal;
      EXPECT_NEAR(E.Moment,
                  C.Shutter->Start - 0.5 + C.Shutter->Across * At.x / C.Width +
                      C.Shutter->Down * At.y / C.Height,
                  1e-14);
      const glm::dvec3 Own = turnedBySteps(C.Shutter->Turn, -E.Moment,
                                           P - E.Moment * C.Shutter->Motion);
      glm::dvec2 Place;
      ASSERT_TRUE(placeThrough(C.Optics, Own, Place));
      for (int K = 0; K < 2; ++K)
        EXPECT_NEAR(E.Place[K], Place[K], 1e-8);
    }
  }
}

TEST(Shutter, RowsAreDifferencesOfPlaces) {
  for (const LensModel *M :
       {&lenses::Pinhole, &lenses::OpenCv, &lenses::Fisheye}) {
    const auto C = moving(M);
    const glm::dvec3 P(0.3, -0.2, 1.5);
    ExposedPoint E;
    ASSERT_TRUE(expose(C, P, Rules::Gsplat, E));
    for (int K = 0; K < 3; ++K) {
      glm::dvec3 Step(0);
      Step[K] = 1e-6;
      ExposedPoint Up, Down;
      ASSERT_TRUE(expose(C, P + Step, Rules::Gsplat, Up));
      ASSERT_TRUE(expose(C, P - Step, Rules::Gsplat, Down));
      const glm::dvec2 By = C.Focal * (Up.Place - Down.Place) / 2e-6;
      EXPECT_NEAR(E.Rows.X[K], By.x, 1e-7);
      EXPECT_NEAR(E.Rows.Y[K], By.y, 1e-7);
    }
  }
}

TEST(Shutter, APictureThatFollowsItsShutterIsNotDrawn) {
  // 50 px a radian, downwards: more than a quarter of 48 rows is left, or less.
  auto C = frontCamera(64, 48, 50);
  ExposedPoint E;
  C.Shutter = {0, 0, 1, {}, {0.7, 0, 0}};
  EXPECT_TRUE(expose(C, {0, 0, 1}, Rules::Inria, E));
  C.Shutter->Turn.x = 0.75;
  EXPECT_FALSE(expose(C, {0, 0, 1}, Rules::Inria, E));
  C.Shutter->Turn.x = -0.9;
  EXPECT_TRUE(expose(C, {0, 0, 1}, Rules::Inria, E));
}

/// \p C where it is when it exposes row \p Row.
Camera<double> atRow(const Camera<double> &C, int Row) {
  const double Moment =
      C.Shutter->Start - 0.5 + C.Shutter->Down * (Row + 0.5) / C.Height;
  Camera<double> Still = C;
  Still.Shutter.reset();
  for (int K = 0; K < 3; ++K) {
    glm::dvec3 Axis(0);
    Axis[K] = 1;
    Still.Rotation[K] = turnedBySteps(C.Shutter->Turn, -Moment, Axis);
  }
  Still.Centre = Moment * C.Shutter->Motion;
  Still.Translation = -multiply(Still.Rotation, Still.Centre);
  return Still;
}

TEST(Shutter, PicturesAreThoseOfTheirRows) {
  auto C = frontCamera(48, 32, 40);
  C.Shutter = {0, 0, 1, {0.1, 0.05, 0.05}, {0.02, 0.06, 0.05}};
  Gaussians<double> G;
  for (int I = 0; I < 40; ++I)
    addRound(
        G, {0.9 * std::sin(I * 1.7), 0.7 * std::cos(I * 2.3), 2 + 0.05 * I},
        0.06, 0.5, {0.5 + 0.5 * std::sin(I), 0.5, 0.5 + 0.5 * std::cos(I)});
  Options O;
  O.Rule = Rules::Gsplat;
  const auto Rolling = render(G, C, O);
  double Squares = 0, Moved = 0;
  auto Global = C;
  Global.Shutter.reset();
  const auto Still = render(G, Global, O);
  for (int Y = 0; Y < C.Height; ++Y) {
    const auto Own = render(G, atRow(C, Y), O);
    for (int X = 0; X < C.Width; ++X)
      for (int K = 0; K < 3; ++K) {
        const auto At = static_cast<std::size_t>(Y * C.Width + X);
        const double D = Rolling.Render[At][K] - Own.Render[At][K];
        const double M = Rolling.Render[At][K] - Still.Render[At][K];
        Squares += D * D;
        Moved += M * M;
      }
  }
  const double Count = 3.0 * C.Width * C.Height;
  // Each Gaussian moves as an affine map says: what is left is of second order.
  EXPECT_GT(-10 * std::log10(Squares / Count), 55);
  EXPECT_LT(-10 * std::log10(Moved / Count), 30);
}

/// How well the footprints' picture agrees with those of its rows, in dB.
double agreementWithRows(const Gaussians<double> &G, const Camera<double> &C,
                         const Options &O) {
  const auto Rolling = render(G, C, O);
  double Squares = 0;
  for (int Y = 0; Y < C.Height; ++Y) {
    const auto Own = render(G, atRow(C, Y), O);
    for (int X = 0; X < C.Width; ++X) {
      const auto At = static_cast<std::size_t>(Y * C.Width + X);
      const glm::dvec3 Off = Rolling.Render[At] - Own.Render[At];
      Squares += glm::dot(Off, Off);
    }
  }
  return -10 * std::log10(Squares / double(3 * Rolling.Render.size()));
}

/// Gaussians much smaller than a pixel are nearly all dilation.
TEST(Shutter, TheDilationIsThatOfEachRowsOwnCamera) {
  auto C = frontCamera(48, 32, 40);
  C.Shutter = {0, 0, 1, {}, {-0.1, 0.3, 0}};
  Gaussians<double> G;
  for (int I = 0; I < 5; ++I)
    addRound(G, {0.3 * (I - 2), 0.2 * std::sin(2 * I), 2}, 0.001, 0.9,
             glm::dvec3(1));
  for (const Spread S : {Spread::Jacobian, Spread::Unscented})
    for (const bool Antialiased : {false, true}) {
      Options O;
      O.Through = S;
      O.Antialiased = Antialiased;
      EXPECT_GT(agreementWithRows(G, C, O), 60);
    }
}

TEST(Shutter, PicturesAlongRaysAreThoseOfTheirRows) {
  for (const LensModel *M : {&lenses::Pinhole, &lenses::OpenCv,
                             &lenses::Fisheye, &lenses::Orthographic}) {
    auto C = moving(M);
    C.Width = 24;
    C.Height = 16;
    C.Shutter->Across = 0;
    setLens(C, *M, C.Optics.K);
    // Some come in front of the near plane, and some leave it.
    const auto G = randomGaussians(60, 5);
    const auto Rolling = renderAlongRays(G, C, {});
    for (int Y = 0; Y < C.Height; ++Y) {
      const auto Own = renderAlongRays(G, atRow(C, Y), {});
      for (int X = 0; X < C.Width; ++X)
        for (int K = 0; K < 3; ++K) {
          const auto At = static_cast<std::size_t>(Y * C.Width + X);
          EXPECT_NEAR(Rolling.Render[At][K], Own.Render[At][K], 1e-6);
        }
    }
  }
}

/// How well the footprints' picture agrees with that along rays, in dB.
double agreement(const Gaussians<double> &G, const Camera<double> &C,
                 Spread Through) {
  Options O;
  O.Through = Through;
  const auto Drawn = render(G, C, O), Seen = renderAlongRays(G, C, O);
  double Squares = 0;
  for (std::size_t I = 0; I < Drawn.Render.size(); ++I) {
    const glm::dvec3 Off = Drawn.Render[I] - Seen.Render[I];
    Squares += glm::dot(Off, Off);
  }
  return -10 * std::log10(Squares / double(3 * Drawn.Render.size()));
}

/// The drift of such places is many times that of where the rows are held.
TEST(Shutter, WhatIsFarBesideThePictureDoesNotCoverIt) {
  Gaussians<double> G;
  addRound(G, {31, -2.5, 4.5}, 1.5, 1, glm::dvec3(1));
  for (const LensModel *M : {&lenses::Pinhole, &lenses::OpenCv}) {
    auto C = frontCamera(120, 68, 104);
    setLens(C, *M, {});
    C.Shutter = {0, 0, 1, {0.02, 0, 0.03}, {0.01, 0.05, 0.01}};
    for (const Spread S : {Spread::Jacobian, Spread::Unscented})
      EXPECT_GT(agreement(G, C, S), 50) << M->Name;
  }
}

TEST(Shutter, TheNearPlaneIsThatOfTheMeansOwnMoment) {
  auto C = frontCamera(64, 48, 55);
  C.Shutter = {0, 0, 1, {0, 0, 0.5}, {}};
  Options O;
  // The upper rows are exposed before the pose and from farther back.
  Gaussians<double> G;
  addRound(G, {0, -0.04, 0.15}, 0.002, 0.9, glm::dvec3(1));
  addRound(G, {0, 0.02, 0.25}, 0.002, 0.9, glm::dvec3(1));
  for (const Spread S : {Spread::Jacobian, Spread::Unscented}) {
    O.Through = S;
    EXPECT_TRUE(project(G, 0, C, O).Visible);
    EXPECT_FALSE(project(G, 1, C, O).Visible);
  }
}

} // namespace
