#include "Backward.h"
#include "Lens.h"
#include "Render.h"
#include "TestScenes.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

constexpr int Width = 20, Height = 16;

/// A loss of every pixel with weights of both signs, by number alone.
Upstream upstream() {
  Upstream U;
  for (int I = 0; I < Width * Height; ++I) {
    U.Render.emplace_back(std::sin(1.3 * I), std::cos(0.7 * I),
                          std::sin(0.37 * I + 1));
    U.Alpha.push_back(std::cos(0.9 * I + 2));
  }
  return U;
}

double loss(const Gaussians<double> &G, const Camera<double> &C,
            const Options &O) {
  const auto P = render(G, C, O);
  const Upstream U = upstream();
  double Sum = 0;
  for (std::size_t I = 0; I < P.Render.size(); ++I)
    Sum += glm::dot(P.Render[I], U.Render[I]) +
           (1 - P.Transmittance[I]) * U.Alpha[I];
  return Sum;
}

/// A camera that looks obliquely, so that no term of a rotation is 0.
Camera<double> obliqueCamera() {
  auto C = frontCamera(Width, Height, 18);
  const double A = 0.3, B = -0.2;
  const glm::dmat3 AboutY(std::cos(A), 0, -std::sin(A), 0, 1, 0, std::sin(A), 0,
                          std::cos(A));
  const glm::dmat3 AboutX(1, 0, 0, 0, std::cos(B), std::sin(B), 0, -std::sin(B),
                          std::cos(B));
  C.Rotation = AboutY * AboutX;
  C.Translation = {0.1, -0.05, 0.4};
  C.Centre = -(glm::transpose(C.Rotation) * C.Translation);
  C.Principal = {9.3, 8.4};
  return C;
}

/// A few Gaussians that overlap, with colours of degree 3. \p Offset moves them
/// out of the picture.
Gaussians<double> smallScene(unsigned Seed, double Offset = 0) {
  std::mt19937 Engine(Seed);
  const auto Uniform = [&](double Low, double High) {
    return Low + (High - Low) * double(Engine()) / double(Engine.max());
  };
  Gaussians<double> G;
  G.ShDegree = 3;
  for (int I = 0; I < 7; ++I) {
    G.Means.emplace_back(Uniform(-0.5, 0.5) + Offset, Uniform(-0.4, 0.4),
                         Uniform(1.2, 2.5));
    G.Scales.emplace_back(Uniform(0.05, 0.4), Uniform(0.05, 0.4),
                          Uniform(0.05, 0.4));
    const glm::dvec4 Q(Uniform(-1, 1), Uniform(-1, 1), Uniform(-1, 1),
                       Uniform(-1, 1));
    G.Quats.push_back(Q / glm::length(Q));
    G.Opacities.push_back(Uniform(0.1, 0.95));
    for (int K = 0; K < 16; ++K)
      G.Sh.emplace_back(Uniform(-0.3, 0.3), Uniform(-0.3, 0.3),
                        Uniform(-0.3, 0.3));
  }
  return G;
}

/// d(loss)/d(*Value) by a central difference; normalises quaternions as the
/// training frameworks do before they are rendered.
double difference(Gaussians<double> &G, const Camera<double> &C,
                  const Options &O, double *Value) {
  constexpr double Step = 1e-6;
  const double Before = *Value;
  const auto At = [&](double V) {
    *Value = V;
    Gaussians<double> Unit = G;
    for (auto &Q : Unit.Quats)
      Q /= glm::length(Q);
    return loss(Unit, C, O);
  };
  const double High = At(Before + Step), Low = At(Before - Step);
  *Value = Before;
  return (High - Low) / (2 * Step);
}

void expectDifferences(Gaussians<double> G, const Camera<double> &C,
                       const Options &O) {
  const Gradients D = renderBackward(G, C, upstream(), O);
  double Largest = 0;
  const auto Expect = [&](const char *What, std::size_t I, double *Value,
                          double Gradient) {
    const double Expected = difference(G, C, O, Value);
    Largest = std::max(Largest, std::abs(Expected));
    EXPECT_NEAR(Gradient, Expected, 1e-6 * std::max(1., std::abs(Expected)))
        << What << " of Gaussian " << I;
  };
  for (std::size_t I = 0; I < G.size(); ++I) {
    for (int K = 0; K < 3; ++K) {
      Expect("mean", I, &G.Means[I][K], D.Means[I][K]);
      Expect("scale", I, &G.Scales[I][K], D.Scales[I][K]);
      for (std::size_t B = 16 * I; B < 16 * (I + 1); ++B)
        Expect("harmonic", I, &G.Sh[B][K], D.Sh[B][K]);
    }
    for (int K = 0; K < 4; ++K)
      Expect("quaternion", I, &G.Quats[I][K], D.Quats[I][K]);
    Expect("opacity", I, &G.Opacities[I], D.Opacities[I]);
  }
  EXPECT_GT(Largest, 0.1); // there was something to compare
}

TEST(Backward, IsTheDerivativeUnderBothRules) {
  for (const Rules Rule : {Rules::Inria, Rules::Gsplat})
    for (const bool Antialiased : {false, true}) {
      Options O;
      O.Rule = Rule;
      O.Antialiased = Antialiased;
      O.Background = {0.3, 0.6, 0.1};
      expectDifferences(smallScene(5), obliqueCamera(), O);
    }
}

TEST(Backward, GsplatDifferentiatesTheLimitOfTheJacobian) {
  Options O;
  O.Rule = Rules::Gsplat;
  // Means beyond the limit, tails in the picture.
  expectDifferences(smallScene(6, 1.6), obliqueCamera(), O);
}

// Through each lens; of an equirectangular one across the seam too.
TEST(Backward, IsTheDerivativeThroughLenses) {
  struct {
    const LensModel *Model;
    LensCoefficients K;
  } const Lenses[] = {{&lenses::OpenCv,
                       {-0.2, 0.05, 0.01, -0.02, 0.01, 0.03, 0.02, 0.01, 0.02,
                        -0.01, 0.03, 0, 0.01}},
                      {&lenses::Division, {-0.3}},
                      {&lenses::Eucm, {0.6, 1.2}},
                      {&lenses::Fisheye, {0.1, -0.02, 0.01, 0.002}},
                      {&lenses::Orthographic, {}},
                      {&lenses::Equirectangular, {}}};
  for (const auto &[Model, K] : Lenses)
    for (const Rules Rule : {Rules::Inria, Rules::Gsplat})
      for (const double Offset : {0., 0.7}) {
        Options O;
        O.Rule = Rule;
        O.Antialiased = Offset == 0;
        auto C = obliqueCamera();
        if (Model == &lenses::Equirectangular) {
          C.Focal = {Width / (2 * M_PI), Height / M_PI};
          C.Principal = {0.5 * Width, 0.5 * Height};
          if (Offset != 0) { // it looks back
            C.Rotation[0] *= -1;
            C.Rotation[1] *= 1;
            C.Rotation[2] *= -1;
            C.Translation = {};
            C.Centre = {};
          }
        }
        setLens(C, *Model, K);
        expectDifferences(smallScene(9, Offset), C, O);
      }
}

struct {
  const LensModel *Model;
  LensCoefficients K;
} const Lenses[] = {{&lenses::Pinhole, {}},
                    {&lenses::OpenCv,
                     {-0.2, 0.05, 0.01, -0.02, 0.01, 0.03, 0.02, 0.01, 0.02,
                      -0.01, 0.03, 0, 0.01}},
                    {&lenses::Division, {-0.2}},
                    {&lenses::Eucm, {0.6, 1.2}},
                    {&lenses::Fisheye, {0.1, -0.02, 0.01, 0.002}},
                    {&lenses::Orthographic, {}},
                    {&lenses::Equirectangular, {}}};

Camera<double> obliqueCameraThrough(const LensModel *Model,
                                    const LensCoefficients &K) {
  auto C = obliqueCamera();
  if (Model == &lenses::Equirectangular) {
    C.Focal = {Width / (2 * M_PI), Height / M_PI};
    C.Principal = {0.5 * Width, 0.5 * Height};
  }
  setLens(C, *Model, K);
  return C;
}

/// It rolls down and across.
constexpr RollingShutter Rolling{
    -0.1, 0.2, 1, {0.1, -0.15, 0.05}, {0.05, -0.1, 0.1}};

// By the Jacobian, through each lens and through a shutter that rolls down and
// across, in the picture and beyond where the Jacobian is held. What INRIA's
// rules give of a pinhole's is no derivative, because they take what is held as
// a constant.
TEST(Backward, IsTheDerivativeThroughShutters) {
  for (const auto &[Model, K] : Lenses)
    for (const Rules Rule : {Rules::Inria, Rules::Gsplat})
      for (const double Offset : {0., 0.9}) {
        if (Offset > 0 && Model == &lenses::Pinhole && Rule == Rules::Inria)
          continue;
        Options O;
        O.Rule = Rule;
        O.Antialiased = Offset == 0;
        auto C = obliqueCameraThrough(Model, K);
        C.Shutter = Rolling;
        expectDifferences(smallScene(9, Offset), C, O);
      }
}

// As seven points, through each lens and through a shutter that rolls down and
// across. The smallest scale keeps all points in view.
TEST(Backward, IsTheDerivativeThroughSevenPoints) {
  for (const auto &[Model, K] : Lenses)
    for (const bool Rolls : {false, true}) {
      Options O;
      O.Through = Spread::Unscented;
      O.Rule = Rolls ? Rules::Inria : Rules::Gsplat;
      auto C = obliqueCameraThrough(Model, K);
      if (Rolls)
        C.Shutter = Rolling;
      auto G = smallScene(11);
      for (auto &S : G.Scales)
        S *= 0.6;
      for (const bool Antialiased : {false, true}) {
        O.Antialiased = Antialiased;
        expectDifferences(G, C, O);
      }
    }
}

TEST(Backward, OneGaussianHasItsClosedForm) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0.1, 0.8, {0.9, 0.5, 0.1});
  const auto C = frontCamera(Width, Height, 50);
  Options O;
  O.Background = {0.2, 0.3, 0.4};
  Upstream U;
  U.Render.resize(Width * Height, glm::dvec3(0));
  U.Alpha.resize(Width * Height, 0);
  constexpr std::size_t At = 8 * Width + 11; // centre (11.5, 8.5)
  U.Render[At] = {1, 2, 3};
  U.Alpha[At] = 0.5;
  const Gradients D = renderBackward(G, C, U, O);
  const double V = 6.55; // (f s / z)^2 + dilation
  const double Dx = 1.5, Dy = 0.5;
  const double A = 0.8 * std::exp(-(Dx * Dx + Dy * Dy) / (2 * V));
  const double ByAlpha = (0.7 + 2 * 0.2 + 3 * -0.3) + 0.5;
  EXPECT_NEAR(D.Colors[0].g, A * 2, 1e-14);
  EXPECT_NEAR(D.Opacities[0], A / 0.8 * ByAlpha, 1e-14);
  EXPECT_NEAR(D.Means2d[0].x, A * ByAlpha * Dx / V, 1e-14);
  EXPECT_NEAR(D.Conics[0][1], -A * ByAlpha * Dx * Dy, 1e-14);
  EXPECT_NEAR(D.Sums[0].Sdd[2], A * ByAlpha * Dy * Dy, 1e-14);
}

TEST(Backward, TheClampOfAlphaPassesOnlyUnderInriasRules) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 30, 1, {1, 1, 1});
  const auto C = frontCamera(Width, Height, 50);
  Options O;
  const Upstream U{std::vector<glm::dvec3>(Width * Height, glm::dvec3(1)),
                   std::vector<double>(Width * Height, 0)};
  EXPECT_GT(renderBackward(G, C, U, O).Opacities[0], 100);
  O.Rule = Rules::Gsplat;
  EXPECT_EQ(renderBackward(G, C, U, O).Opacities[0], 0);
  EXPECT_GT(renderBackward(G, C, U, O).Colors[0].r, 100);
}

TEST(Backward, WhatIsNotSeenGetsNothing) {
  Gaussians<double> G = smallScene(7);
  G.Means[2] = {0, 0, -3};   // behind the camera
  G.Means[4] = {50, 0, 2};   // beside the picture
  G.Opacities[5] = 1. / 300; // never blended
  const auto D = renderBackward(G, obliqueCamera(), upstream(), {});
  for (const std::size_t I : {2, 4, 5}) {
    EXPECT_EQ(D.Means[I], glm::dvec3(0));
    EXPECT_EQ(D.Scales[I], glm::dvec3(0));
    EXPECT_EQ(D.Quats[I], glm::dvec4(0));
    EXPECT_EQ(D.Opacities[I], 0);
    for (std::size_t K = 16 * I; K < 16 * (I + 1); ++K)
      EXPECT_EQ(D.Sh[K], glm::dvec3(0));
  }
}

TEST(Backward, ThreadsChangeNothing) {
  Options O;
  O.Threads = 1;
  const auto One =
      renderBackward(smallScene(8), obliqueCamera(), upstream(), O);
  O.Threads = 3;
  const auto Three =
      renderBackward(smallScene(8), obliqueCamera(), upstream(), O);
  EXPECT_EQ(One.Means, Three.Means);
  EXPECT_EQ(One.Sh, Three.Sh);
}

} // namespace
