// The judge of footprints by what it must be: rays that lead back to their
// pixels, one Gaussian by its formula, and footprints so small that they are
// exact.

#include "AlongRays.h"
#include "Lens.h"
#include "Ray.h"
#include "Shutter.h"
#include "TestScenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

/// Of a pixel in the picture.
std::size_t numberOf(const Camera<double> &C, int X, int Y) {
  return static_cast<std::size_t>(Y) * static_cast<std::size_t>(C.Width) +
         static_cast<std::size_t>(X);
}

Camera<double> camera(const LensModel *M) {
  auto C = frontCamera(64, 48, M == &lenses::Fisheye ? 20 : 50);
  if (M == &lenses::Equirectangular)
    C.Focal = {C.Width / (2 * M_PI), C.Height / M_PI};
  LensCoefficients K{};
  if (M == &lenses::OpenCv)
    K = {-0.25, 0.08, 0.004, -0.006, -0.01, 0.02, 0.03, 0.01, 0.003, -0.001};
  if (M == &lenses::Division)
    K = {-0.2};
  if (M == &lenses::Eucm)
    K = {0.6, 1.2};
  if (M == &lenses::Fisheye)
    K = {0.06, -0.02, 0.005};
  setLens(C, *M, K);
  return C;
}

TEST(AlongRays, APointOnARayIsSeenAtItsPixel) {
  for (const LensModel *M : lenses::all())
    for (const bool Rolls : {false, true}) {
      auto C = camera(M);
      if (Rolls)
        C.Shutter = {-0.1, 0.15, 1.1, {0.3, -0.2, 0.1}, {0.15, -0.1, 0.2}};
      for (const glm::dvec2 At :
           {glm::dvec2(6.5, 9.5), {31.5, 24.5}, {32, 24}, {60.5, 40.5}}) {
        const auto R = rayAt(C, At);
        ASSERT_TRUE(R);
        EXPECT_NEAR(glm::length(R->Direction), 1, 1e-12);
        const glm::dvec3 P = R->Origin + 1.5 * R->Direction;
        glm::dvec2 Place;
        if (Rolls) {
          ExposedPoint E;
          ASSERT_TRUE(expose(C, P, Rules::Inria, E));
          Place = E.Place;
        } else {
          ASSERT_TRUE(placeThrough(C.Optics, P, Place));
        }
        const glm::dvec2 Off = C.Focal * Place + C.Principal - At;
        EXPECT_NEAR(glm::length(Off), 0, 1e-6);
      }
    }
}

TEST(AlongRays, WhatAFisheyeDoesNotShowHasNoRay) {
  auto C = frontCamera(64, 48, 5);
  setLens(C, lenses::Fisheye, {});
  EXPECT_TRUE(rayAt(C, {32, 24.5}));
  EXPECT_FALSE(rayAt(C, {0.5, 0.5}));
}

TEST(AlongRays, OneGaussianIsItsLargestDensityOnEachRay) {
  const auto C = camera(&lenses::Pinhole);
  const double Z = 2, Scale = 0.3, Opacity = 0.8;
  Gaussians<double> G;
  addRound(G, {0.2, -0.1, Z}, Scale, Opacity, glm::dvec3(1));
  Options O, Four;
  O.Dilation = Four.Dilation = 0;
  Four.FalloffDegree = 4;
  const auto P = renderAlongRays(G, C, O), PFour = renderAlongRays(G, C, Four);
  for (const glm::ivec2 Pixel : {glm::ivec2(20, 10), {37, 21}, {50, 40}}) {
    const glm::dvec3 Ray((glm::dvec2(Pixel) + 0.5 - C.Principal) / C.Focal, 1);
    const glm::dvec3 Beside =
        glm::cross(Ray, G.Means[0]) / (glm::length(Ray) * Scale);
    const double Alpha = Opacity * std::exp(-0.5 * glm::dot(Beside, Beside));
    const auto At = numberOf(C, Pixel.x, Pixel.y);
    EXPECT_NEAR(P.Render[At].x, Alpha, 1e-12);
    EXPECT_NEAR(P.Transmittance[At], 1 - Alpha, 1e-12);
    const double Q = glm::dot(Beside, Beside);
    EXPECT_NEAR(PFour.Render[At].x, Opacity * std::exp(-Q * Q / 18), 1e-12);
  }
  // On the ray through the mean the dilation is that of a footprint.
  O.Dilation = 0.3;
  G.Means[0] = {0, 0, Z};
  auto Centred = C;
  Centred.Principal = {32.5, 24.5};
  const auto D = renderAlongRays(G, Centred, O);
  const double Variance = Scale * Scale + 0.3 * Z * Z / (C.Focal.x * C.Focal.x);
  EXPECT_NEAR(D.Render[24 * 64 + 32].x, Opacity, 1e-12);
  EXPECT_NEAR(D.Render[25 * 64 + 32].x,
              Opacity * std::exp(-0.5 / 2501 * Z * Z * 2501 / 2500 / Variance),
              1e-4);
}

TEST(AlongRays, TracedOrderIsThatOfTheDensest) {
  auto C = camera(&lenses::Pinhole);
  C.Principal = {32.5, 24.5};
  Options O;
  O.Dilation = 0;
  // A sheet whose mean is nearer than a ball, but which is farther where the
  // ball is: at 2 / (1 - 0.24 tan 0.8) = 2.66.
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0, 0.9, {1, 0, 0});
  G.Scales[0] = {3, 3, 0.001};
  G.Quats[0] = {std::cos(0.4), 0, -std::sin(0.4), 0};
  addRound(G, {0.5, 0, 2.1}, 0.1, 0.9, {0, 1, 0});
  const auto At = numberOf(C, 44, 24);
  const auto Seen = renderAlongRays(G, C, O, RayDepths::Ray).Render[At];
  EXPECT_NEAR(Seen.y, 0.9, 0.01);
  EXPECT_NEAR(Seen.x, 0.09, 0.01);
  const auto ByMeans = renderAlongRays(G, C, O).Render[At];
  EXPECT_GT(ByMeans.x, 0.8);
  EXPECT_LT(ByMeans.y, 0.2);
  // The near plane takes where it is densest, at -1.24 and 1.23, not the mean.
  G.Means[0] = {1, 0, 0.1};
  EXPECT_EQ(renderAlongRays(G, C, O, RayDepths::Ray).Render[At].x, 0);
  G.Means[0] = {-1, 0, -0.1};
  EXPECT_GT(renderAlongRays(G, C, O, RayDepths::Ray).Render[At].x, 0.7);
  // Depths within the band are doubtful.
  Gaussians<double> Two;
  addRound(Two, {0, 0, 2}, 0.3, 0.4, glm::dvec3(1));
  addRound(Two, {0, 0, 2 * (1 + 5e-6)}, 0.3, 0.5, glm::dvec3(1));
  const auto Centre = numberOf(C, 32, 24);
  EXPECT_EQ(renderAlongRays(Two, C, O, RayDepths::Ray).Doubts[Centre],
            DoubtOrder);
  EXPECT_EQ(renderAlongRays(Two, C, O).Doubts[Centre], 0);
}

TEST(AlongRays, DoubtfulPixelsAreNearAThresholdOrHaveEqualDepths) {
  auto C = camera(&lenses::Pinhole);
  C.Principal = {32.5, 24.5};
  const auto DoubtOf = [&](double Opacity, double Behind) {
    Gaussians<double> G;
    addRound(G, {0, 0, 2}, 0.3, Opacity, glm::dvec3(1));
    addRound(G, {0, 0, 2 * Behind}, 0.3, 0.5, glm::dvec3(1));
    return renderAlongRays(G, C, {}).Doubts[24 * 64 + 32];
  };
  EXPECT_EQ(DoubtOf(0.4, 1.5), 0);
  EXPECT_EQ(DoubtOf((1 + 5e-6) / 255, 1.5), DoubtThreshold);
  EXPECT_EQ(DoubtOf((1 - 5e-6) / 255, 1.5), DoubtThreshold);
  EXPECT_EQ(DoubtOf(0.4, 1 + 1e-7), DoubtOrder);
  EXPECT_EQ(DoubtOf(0.4, 1 + 5e-7), 0);
}

TEST(AlongRays, SmallFootprintsAreTheSame) {
  for (const LensModel *M : lenses::all()) {
    auto C = camera(M);
    Gaussians<double> G;
    for (int I = 0; I < 60; ++I)
      addRound(G,
               {0.9 * std::sin(I * 1.7), 0.7 * std::cos(I * 2.3), 2 + 0.05 * I},
               0.01, 0.7, {0.5 + 0.5 * std::sin(I), 0.5, 0.2});
    const auto Drawn = render(G, C, {}), Seen = renderAlongRays(G, C, {});
    double Squares = 0, Light = 0;
    for (std::size_t I = 0; I < Drawn.Render.size(); ++I) {
      const glm::dvec3 Off = Drawn.Render[I] - Seen.Render[I];
      Squares += glm::dot(Off, Off);
      Light += glm::dot(Seen.Render[I], Seen.Render[I]);
    }
    EXPECT_GT(Light, 1);
    EXPECT_LT(Squares, 1e-4 * Light) << M->Name;
  }
}

double lossOf(const Gaussians<double> &G, const Camera<double> &C,
              const Upstream &U, const Options &O) {
  Gaussians<double> Unit = G;
  for (auto &Q : Unit.Quats)
    Q /= glm::length(Q);
  const auto P = renderAlongRays(Unit, C, O);
  double Sum = 0;
  for (std::size_t I = 0; I < P.Render.size(); ++I)
    Sum += glm::dot(P.Render[I], U.Render[I]) +
           (1 - P.Transmittance[I]) * U.Alpha[I];
  return Sum;
}

/// Large Gaussians in front of the camera, one around it, and one opaque;
/// colours of degree 1. As \p Surfels without their third scales, two of them
/// smaller than a pixel.
Gaussians<double> nearScene(bool Surfels) {
  Gaussians<double> G;
  G.ShDegree = 1;
  for (int I = 0; I < 6; ++I) {
    G.Means.emplace_back(0.4 * std::sin(1.7 * I), 0.3 * std::cos(2.3 * I),
                         I == 0 ? 0.3 : 1 + 0.3 * I);
    G.Scales.emplace_back(0.3 + 0.1 * std::sin(I), 0.2 + 0.05 * I,
                          0.25 + 0.1 * std::cos(3 * I));
    const glm::dvec4 Q(1, 0.3 * I, 0.5 - 0.2 * I, 0.1 + 0.1 * I);
    G.Quats.push_back(Q / glm::length(Q));
    G.Opacities.push_back(I == 1 ? 1 : 0.3 + 0.1 * I);
    for (int K = 0; K < 4; ++K)
      G.Sh.emplace_back(0.2 * std::sin(I + K), 0.1 * std::cos(2 * I + K), 0.1);
    if (Surfels)
      G.Scales.back() *= glm::dvec3(glm::dvec2(I % 3 == 2 ? 0.1 : 1), 0);
  }
  return G;
}

TEST(AlongRays, GradientsAreTheDerivative) {
  for (const LensModel *M : {&lenses::Pinhole, &lenses::Orthographic})
    for (const auto &[Rule, Surfels, Degree] :
         {std::tuple{Rules::Inria, false, 2},
          {Rules::Inria, false, 4},
          {Rules::Gsplat, false, 2},
          {Rules::Gsplat, true, 2}}) {
      auto C = frontCamera(20, 16, 14);
      setLens(C, *M, {});
      C.Rotation = glm::dmat3(0.8, 0.36, -0.48, 0, 0.8, 0.6, 0.6, -0.48, 0.64);
      C.Translation = {0.1, -0.05, 0.1};
      C.Centre = -(glm::transpose(C.Rotation) * C.Translation);
      Options O;
      O.Dilation = 0;
      O.Rule = Rule;
      O.LowPass = Surfels;
      O.FalloffDegree = Degree;
      O.Near = 0.05;
      O.Background[1] = 0.4F;
      Upstream U;
      for (int I = 0; I < C.Width * C.Height; ++I) {
        U.Render.emplace_back(std::sin(1.3 * I), std::cos(0.7 * I),
                              std::sin(0.37 * I + 1));
        U.Alpha.push_back(std::cos(0.9 * I + 2));
      }
      Gaussians<double> G = nearScene(Surfels);
      for (auto &Mean : G.Means)
        Mean = glm::transpose(C.Rotation) * (Mean - C.Translation);
      // No alpha is near 0.99, below which INRIA's rules go on as if it were
      // not clamped.
      if (Rule == Rules::Inria)
        G.Opacities[1] = 0.9;
      const Gradients D = alongRaysBackward(G, C, U, O);
      double Largest = 0;
      const auto Expect = [&](const char *What, double &Value, double Is) {
        constexpr double Step = 1e-6;
        const double Before = Value;
        Value = Before + Step;
        const double High = lossOf(G, C, U, O);
        Value = Before - Step;
        const double Right = (High - lossOf(G, C, U, O)) / (2 * Step);
        Value = Before;
        Largest = std::max(Largest, std::abs(Right));
        EXPECT_NEAR(Is, Right, 2e-6 * std::max(1., std::abs(Right)))
            << What << ' ' << M->Name;
      };
      for (std::size_t I = 0; I < G.size(); ++I) {
        for (int K = 0; K < 3; ++K) {
          Expect("mean", G.Means[I][K], D.Means[I][K]);
          Expect("scale", G.Scales[I][K], D.Scales[I][K]);
        }
        for (int K = 0; K < 4; ++K)
          Expect("quaternion", G.Quats[I][K], D.Quats[I][K]);
        Expect("opacity", G.Opacities[I], D.Opacities[I]);
        for (std::size_t K = 0; K < 4; ++K)
          Expect("harmonic", G.Sh[4 * I + K].y, D.Sh[4 * I + K].y);
      }
      EXPECT_GT(Largest, 1);
    }
}

TEST(AlongRays, ASurfelIsItsDiscOrABlurOfAPixel) {
  const auto C = camera(&lenses::Pinhole);
  Options O;
  O.Dilation = 0;
  O.LowPass = true;
  // Turned about the picture's y axis, up to an edge that no ray meets.
  for (const double Turn : {0.0, 0.7, 1.5, M_PI / 2}) {
    Gaussians<double> G;
    const glm::dvec3 Mean(0.1, 0.05, 2);
    addRound(G, Mean, 0, 0.8, glm::dvec3(1));
    G.Scales[0] = {0.1, 0.05, 0};
    G.Quats[0] = {std::cos(Turn / 2), 0, std::sin(Turn / 2), 0};
    const glm::dvec3 Along(std::cos(Turn), 0, -std::sin(Turn));
    const glm::dvec3 Normal(std::sin(Turn), 0, std::cos(Turn));
    const auto P = renderAlongRays(G, C, O);
    unsigned Met = 0, Blurred = 0;
    for (int Y = 0; Y < C.Height; ++Y)
      for (int X = 0; X < C.Width; ++X) {
        const glm::dvec2 At(X + 0.5, Y + 0.5);
        const glm::dvec3 Ray((At - C.Principal) / C.Focal, 1);
        const glm::dvec3 Point =
            glm::dot(Normal, Mean) / glm::dot(Normal, Ray) * Ray;
        const double U = glm::dot(Along, Point - Mean) / 0.1,
                     V = (Point - Mean).y / 0.05;
        const glm::dvec2 Off =
            At - (C.Focal * glm::dvec2(Mean) / Mean.z + C.Principal);
        const double OnDisc = std::exp(-0.5 * (U * U + V * V)),
                     OnPicture = std::exp(-glm::dot(Off, Off));
        const double Alpha = 0.8 * std::max(OnDisc, OnPicture);
        const auto I = numberOf(C, X, Y);
        EXPECT_NEAR(P.Render[I].x, Alpha < 1.0 / 255 ? 0 : Alpha, 1e-12)
            << Turn << ' ' << X << ' ' << Y;
        Met += Alpha >= 1.0 / 255 && OnDisc > OnPicture;
        Blurred += Alpha >= 1.0 / 255 && OnDisc < OnPicture;
      }
    EXPECT_GT(Turn < 1 ? Met : Blurred, 5U);
  }
}

TEST(AlongRays, GradientsOfADiscAreThoseOfAThinOne) {
  const auto C = camera(&lenses::Pinhole);
  Options O;
  O.Dilation = 0;
  Upstream U;
  for (int I = 0; I < C.Width * C.Height; ++I) {
    U.Render.emplace_back(std::sin(1.3 * I));
    U.Alpha.push_back(0);
  }
  const auto Of = [&](double Thin) {
    Gaussians<double> G;
    addRound(G, {0.2, -0.1, 2}, 0.3, 0.8, glm::dvec3(1));
    G.Scales[0].z = Thin;
    const glm::dvec4 Q(1, 0.2, -0.3, 0.1);
    G.Quats[0] = Q / glm::length(Q);
    return alongRaysBackward(G, C, U, O);
  };
  const Gradients Disc = Of(0), Thin = Of(1e-7);
  EXPECT_EQ(Disc.Scales[0].z, 0);
  EXPECT_GT(glm::length(Disc.Means[0]), 1e-3);
  EXPECT_NEAR(glm::distance(Disc.Means[0], Thin.Means[0]), 0, 1e-9);
  EXPECT_NEAR(glm::distance(Disc.Quats[0], Thin.Quats[0]), 0, 1e-9);
}

} // namespace
