#include "Render.h"
#include "TestScenes.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vorion::reference;

namespace {

constexpr int Side = 32;

/// Alpha of a round Gaussian with variance \p V at the picture's centre, at
/// pixel (\p X, \p Y), by its definition.
double alphaAt(int X, int Y, double V, double Opacity) {
  const double Dx = X + 0.5 - Side / 2., Dy = Y + 0.5 - Side / 2.;
  const double A =
      std::min(0.99, Opacity * std::exp(-(Dx * Dx + Dy * Dy) / (2 * V)));
  return A < 1. / 255 ? 0 : A;
}

Picture<double> renderRound(const Gaussians<double> &G, const Options &O) {
  return render(G, frontCamera(Side, Side, 50), O);
}

std::size_t at(int X, int Y) { return std::size_t(Side) * Y + X; }

TEST(Render, OneGaussianHasItsClosedForm) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0.1, 0.8, {0.9, 0.5, 0.1});
  Options O;
  O.Background = {0.2, 0.3, 0.4};
  const auto P = renderRound(G, O);
  uint64_t Blends = 0;
  for (int Y = 0; Y < Side; ++Y)
    for (int X = 0; X < Side; ++X) {
      const double A = alphaAt(X, Y, 6.55, 0.8);
      Blends += A > 0;
      EXPECT_NEAR(P.Render[at(X, Y)].r, A * 0.9 + (1 - A) * 0.2, 1e-14);
      EXPECT_NEAR(P.Render[at(X, Y)].b, A * 0.1 + (1 - A) * 0.4, 1e-14);
      EXPECT_NEAR(P.Transmittance[at(X, Y)], 1 - A, 1e-14);
      EXPECT_EQ(P.Last[at(X, Y)], A > 0 ? 0 : -1);
    }
  EXPECT_EQ(P.Blends, Blends);
}

TEST(Render, FrontCoversBackWhateverTheOrderOfTheInput) {
  Gaussians<double> G;
  addRound(G, {0, 0, 3}, 30, 0.6, {0, 0, 1}); // behind, all over the picture
  addRound(G, {0, 0, 2}, 30, 0.5, {1, 0, 0});
  const auto P = renderRound(G, {});
  // Flat to a few parts in 1e4 at a variance of 500 px^2 or more.
  EXPECT_NEAR(P.Render[at(3, 4)].r, 0.5, 1e-3);
  EXPECT_NEAR(P.Render[at(3, 4)].b, 0.5 * 0.6, 1e-3);
  EXPECT_EQ(P.Last[at(3, 4)], 0);
}

TEST(Render, ASurfaceHidesWhatHasItsDepthOrMore) {
  Gaussians<double> G;
  addRound(G, {0, 0, 3}, 30, 0.6, {0, 0, 1});
  addRound(G, {0, 0, 2}, 30, 0.5, {1, 0, 0});
  Options O;
  O.Background = {0, 0, 8};
  Surface<double> Behind;
  Behind.Depths.assign(std::size_t{Side} * Side, 2.5);
  Behind.Colors.assign(std::size_t{Side} * Side, {0, 1, 0});
  Behind.Depths[at(0, 0)] = std::numeric_limits<double>::infinity();
  Behind.Depths[at(1, 0)] = 3; // a tie: the surface is in front
  Behind.Depths[at(2, 0)] = std::nextafter(3.0F, 4.0F);
  Behind.Depths[at(3, 0)] = 1;
  const auto P = render(G, frontCamera(Side, Side, 50), O, &Behind);
  const auto Near = [&](std::size_t At, double R, double Green, double B) {
    EXPECT_NEAR(P.Render[At].r, R, 2e-3) << At;
    EXPECT_NEAR(P.Render[At].g, Green, 2e-3) << At;
    EXPECT_NEAR(P.Render[At].b, B, 2e-2) << At;
  };
  Near(at(5, 5), 0.5, 0.5, 0);
  Near(at(0, 0), 0.5, 0, 0.3 + 0.2 * 8);
  Near(at(1, 0), 0.5, 0.5, 0);
  Near(at(2, 0), 0.5, 0.2, 0.3);
  Near(at(3, 0), 0, 1, 0);
  EXPECT_EQ(P.Doubts[at(5, 5)], 0);
  EXPECT_EQ(P.Transmittance[at(3, 0)], 1);
}

TEST(Render, LayersLieBetweenGaussians) {
  Gaussians<double> G;
  addRound(G, {0, 0, 3}, 30, 0.6, {0, 0, 1});
  addRound(G, {0, 0, 2}, 30, 0.5, {1, 0, 0});
  Surface<double> S;
  S.Depths.assign(std::size_t{Side} * Side,
                  std::numeric_limits<double>::infinity());
  S.Colors.resize(S.Depths.size());
  S.Layers.resize(S.Depths.size());
  const glm::dvec3 Green(0, 1, 0), White(1, 1, 1);
  S.Layers[at(5, 5)] = {{2.5, Green, 0.25}};
  // A tie: the layer is in front. Behind all.
  S.Layers[at(6, 5)] = {{1, White, 0.5}, {3, Green, 1}};
  S.Layers[at(7, 5)] = {{4, Green, 0.5}};
  Options O;
  O.Background = {0, 0, 8};
  const auto P = render(G, frontCamera(Side, Side, 50), O, &S);
  const auto Near = [&](std::size_t At, double R, double Green, double B) {
    EXPECT_NEAR(P.Render[At].r, R, 2e-3) << At;
    EXPECT_NEAR(P.Render[At].g, Green, 2e-3) << At;
    EXPECT_NEAR(P.Render[At].b, B, 2e-2) << At;
  };
  Near(at(4, 5), 0.5, 0, 0.3 + 0.2 * 8);
  Near(at(5, 5), 0.5, 0.125, 0.375 * 0.6 + 0.15 * 8);
  Near(at(6, 5), 0.5 + 0.25, 0.5 + 0.25, 0.5);
  Near(at(7, 5), 0.5, 0.1, 0.3 + 0.1 * 8);
  // The cut-off ends the Gaussians of a pixel, and no layer.
  O.Cutoff = 0.6;
  const auto Ended = render(G, frontCamera(Side, Side, 50), O, &S);
  EXPECT_EQ(Ended.Render[at(5, 5)], glm::dvec3(0, 0.25, 0.75 * 8));
}

TEST(Render, AlphaEndsAt99PerCent) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 30, 1, {1, 1, 1});
  EXPECT_NEAR(renderRound(G, {}).Render[at(16, 16)].r, 0.99, 1e-15);
}

TEST(Render, StopRulesDifferAtTheCutoffItself) {
  // 0.5 of 0.5: T' is the cut-off exactly at the picture's centre.
  Gaussians<double> G;
  for (int I = 0; I < 3; ++I)
    addRound(G, {0, 0, 2 + I}, 30, 0.5, {1, 1, 1});
  auto C = frontCamera(Side, Side, 50);
  C.Principal = {16.5, 16.5};
  Options O;
  O.Cutoff = 0.25;
  const auto Inria = render(G, C, O);
  O.Rule = Rules::Gsplat;
  const auto Gsplat = render(G, C, O);
  EXPECT_EQ(Inria.Transmittance[at(16, 16)], 0.25); // the third would pass it
  EXPECT_EQ(Inria.Last[at(16, 16)], 1);
  EXPECT_EQ(Gsplat.Transmittance[at(16, 16)], 0.5); // stops before it
  EXPECT_EQ(Gsplat.Last[at(16, 16)], 0);
  EXPECT_NE(Inria.Doubts[at(16, 16)] & DoubtThreshold, 0);
  EXPECT_GT(Inria.Saturated, 0U);
}

TEST(Render, SupportsReachTheirPixels) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0.1, 0.9, {1, 1, 1});
  const double Sigma = std::sqrt(6.55);
  const double Radius = std::ceil(3 * std::sqrt(6.55 + std::sqrt(0.1)));
  for (const Support Reach :
       {Support::Exact, Support::Box3, Support::Square3, Support::Official16}) {
    Options O;
    O.Reach = Reach;
    const auto P = renderRound(G, O);
    for (int Y = 0; Y < Side; ++Y)
      for (int X = 0; X < Side; ++X) {
        const double Dx = std::abs(X + 0.5 - Side / 2.);
        const double Dy = std::abs(Y + 0.5 - Side / 2.);
        const double Limit = Reach == Support::Box3      ? 3 * Sigma
                             : Reach == Support::Square3 ? Radius
                                                         : Side;
        const bool Reached =
            alphaAt(X, Y, 6.55, 0.9) > 0 && std::max(Dx, Dy) <= Limit;
        EXPECT_EQ(P.Transmittance[at(X, Y)] < 1, Reached) << X << ' ' << Y;
      }
  }
}

TEST(Render, OfficialSupportEndsWithItsTiles) {
  // The square of radius 5 around m = (7.5, 7.5) touches one tile only, though
  // alpha reaches beyond it.
  Gaussians<double> G;
  addRound(G, {-0.32, -0.32, 2}, 0.06, 1, {1, 1, 1});
  Options O;
  O.Reach = Support::Official16;
  const auto Official = renderRound(G, O);
  O.Reach = Support::Exact;
  const auto Exact = renderRound(G, O);
  EXPECT_EQ(Official.Transmittance[at(15, 8)], Exact.Transmittance[at(15, 8)]);
  std::size_t Beyond = 0;
  for (int Y = 0; Y < Side; ++Y) {
    Beyond += Exact.Transmittance[at(16, Y)] < 1;
    EXPECT_EQ(Official.Transmittance[at(16, Y)], 1);
  }
  EXPECT_EQ(Beyond, 0U); // 8.5 px are more than the ellipse of 1/255
}

TEST(Render, AlphaNearItsThresholdIsDoubtful) {
  auto C = frontCamera(Side, Side, 50);
  C.Principal = {16.5, 16.5};
  const auto DoubtsOf = [&](double Opacity) {
    Gaussians<double> G;
    addRound(G, {0, 0, 2}, 0.001, Opacity, {1, 1, 1});
    return render(G, C, Options{}).Doubts[at(16, 16)];
  };
  EXPECT_EQ(DoubtsOf(1.000005 / 255), DoubtThreshold);
  EXPECT_EQ(DoubtsOf(1.00002 / 255), 0);
  EXPECT_EQ(DoubtsOf(0.5), 0);
}

TEST(Render, AlphasBelowTheCutOffAreLeftOut) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0.1, 0.9, {1, 1, 1});
  addRound(G, {0, 0, 3}, 0.1, 1.9 / 255, {1, 1, 1}); // never reaches 2/255
  Options O;
  O.AlphaCutoff = 2;
  EXPECT_FALSE(project(G, frontCamera(Side, Side, 50), O)[1].Visible);
  const auto P = renderRound(G, O);
  for (int Y = 0; Y < Side; ++Y)
    for (int X = 0; X < Side; ++X) {
      const double A = alphaAt(X, Y, 6.55, 0.9);
      EXPECT_NEAR(P.Render[at(X, Y)].r, A < 2. / 255 ? 0 : A, 1e-14);
    }
}

TEST(Render, FewerDepthBitsOrderEqualOnesByNumber) {
  Gaussians<double> G;
  addRound(G, {0, 0, 2.0001}, 30, 0.5, {0, 0, 1});
  addRound(G, {0, 0, 2}, 30, 0.5, {1, 0, 0});
  Options O;
  EXPECT_GT(renderRound(G, O).Render[at(16, 16)].r, 0.4);
  O.DepthBits = 16; // 7 bits of the significand: 1/64 at a depth of 2
  EXPECT_GT(renderRound(G, O).Render[at(16, 16)].b, 0.4);
  O.DepthBits = 1;
  EXPECT_GT(renderRound(G, O).Render[at(16, 16)].b, 0.4);
}

/// What docs/numerics.md says options may lose: each Gaussian whose alpha is
/// left out at most that alpha, neglected bands at most what they add to a
/// colour.
TEST(Render, CoarserOptionsLoseAtMostTheirBounds) {
  auto G = randomGaussians(12, 7);
  G.Colors.clear();
  G.ShDegree = 2;
  double Neglected = 0;
  for (std::size_t I = 0; I < G.size(); ++I) {
    glm::dvec3 Band(0);
    for (int K = 0; K < 9; ++K) {
      // Nothing is clamped: 0.5 is more than all of them.
      const double V = 0.05 * std::sin(double(I) * 9 + K);
      G.Sh.emplace_back(V, -V, 0.5 * V);
      if (K >= 4)
        Band += glm::abs(G.Sh.back()) * 1.1; // the bases are below 1.1
    }
    Neglected = std::max({Neglected, Band.x, Band.y, Band.z});
  }
  const auto Off = [&](const Options &O) {
    Options Full = O;
    Full.AlphaCutoff = 1;
    Full.ShLimit = 3;
    const auto A = renderRound(G, O), B = renderRound(G, Full);
    double Most = 0;
    for (std::size_t I = 0; I < A.Render.size(); ++I)
      for (int K = 0; K < 3; ++K)
        Most = std::max(Most, std::abs(A.Render[I][K] - B.Render[I][K]));
    return Most;
  };
  Options O;
  O.Cutoff = 0;
  O.ShLimit = 1;
  EXPECT_GT(Off(O), 0.01 * Neglected);
  EXPECT_LT(Off(O), Neglected);
  O.ShLimit = 3;
  O.AlphaCutoff = 4;
  EXPECT_GT(Off(O), 1. / 255);
  EXPECT_LT(Off(O), double(G.size()) * 4 / 255);
}

TEST(Render, TheBorderOfASupportIsDoubtful) {
  // Box of 3 sigma that ends at a pixel's centre: sigma = 2.5 px, mean at a
  // pixel centre 7.5 px away.
  Gaussians<double> G;
  addRound(G, {0, 0, 2}, 0.1, 0.9, {1, 1, 1});
  Options O;
  O.Dilation = 0;
  O.Reach = Support::Box3;
  const auto P = renderRound(G, O); // mean at 16, pixel centre at 8.5
  EXPECT_EQ(P.Doubts[at(8, 15)], DoubtThreshold);
  EXPECT_EQ(P.Doubts[at(23, 15)], DoubtThreshold);
  EXPECT_EQ(P.Doubts[at(9, 15)], 0);
  EXPECT_EQ(P.Doubts[at(7, 15)], 0);
}

TEST(Render, DepthsThatRoundingMaySwapAreDoubtful) {
  const auto DoubtsOf = [](double First, double Second) {
    Gaussians<double> G;
    addRound(G, {0, 0, First}, 0.5, 0.5, {1, 0, 0});
    addRound(G, {0.1, 0, Second}, 0.5, 0.5, {0, 1, 0});
    return renderRound(G, {}).Doubts[at(16, 16)];
  };
  constexpr double Ulp = 0x1p-22; // of fp32 numbers from 2 to 4
  EXPECT_EQ(DoubtsOf(2, 2), 0);
  EXPECT_EQ(DoubtsOf(2 + 0.1 * Ulp, 2), 0); // one key: the index decides
  EXPECT_EQ(DoubtsOf(2 + Ulp, 2), 0);
  // Half-way between two keys either may come out, and may be the other's
  // equal, which is safe only if the indices are in order.
  EXPECT_EQ(DoubtsOf(2 + 0.5 * Ulp, 2 + 0.5 * Ulp), DoubtOrder);
  EXPECT_EQ(DoubtsOf(2 + Ulp, 2 + 0.5 * Ulp), DoubtOrder);
  EXPECT_EQ(DoubtsOf(2 + 0.5 * Ulp, 2 + Ulp), 0);
  EXPECT_EQ(DoubtsOf(2, 2 + 0.5 * Ulp), 0);
}

TEST(Render, DepthIsAsIfExactInSinglePrecision) {
  // 0.6 and 0.8 are no fp32 numbers: their low parts decide what 2^-23 of the
  // depth is.
  const glm::dvec3 Mean(0.33F, 0.7F, 1.91F);
  Gaussians<float> G;
  G.Means = {glm::vec3(Mean)};
  G.Scales = {glm::vec3(0.1F)};
  G.Quats = {glm::vec4(1, 0, 0, 0)};
  G.Opacities = {0.5F};
  G.Colors = {glm::vec3(1)};
  Camera<float> C{32, 32, glm::mat3(1), {}, {}, {50, 50}, {16, 16}, {}, 0};
  C.Rotation[0][2] = 0.6F;
  C.Rotation[2][2] = 0.8F;
  C.DepthAxisLow = {float(0.6 - double(0.6F)), 0, float(0.8 - double(0.8F))};
  const double Exact = 0.6 * Mean.x + 0.8 * Mean.z;
  EXPECT_EQ(project(G, 0, C, Options{}).Depth, static_cast<float>(Exact));
  // What rounding each operation gives, to show that it is another number.
  EXPECT_NE(0.6F * G.Means[0].x + 0.8F * G.Means[0].z,
            static_cast<float>(Exact));
}

TEST(Render, ThreadsAndTileSizeChangeNoPixel) {
  const auto C = frontCamera(75, 53, 60);
  const auto G = randomGaussians(400, 2);
  for (const Support Reach : {Support::Exact, Support::Square3}) {
    Options O;
    O.Reach = Reach;
    O.Threads = 1;
    const auto One = render(G, C, O);
    O.Threads = 5;
    const auto Five = render(G, C, O);
    EXPECT_EQ(One.Walked, Five.Walked);
    O.TileSize = 64;
    const auto Large = render(G, C, O);
    for (const auto *P : {&Five, &Large}) {
      EXPECT_EQ(One.Render, P->Render);
      EXPECT_EQ(One.Transmittance, P->Transmittance);
      EXPECT_EQ(One.Doubts, P->Doubts);
      EXPECT_EQ(One.Last, P->Last);
      EXPECT_EQ(One.Blends, P->Blends);
      EXPECT_EQ(One.Saturated, P->Saturated);
    }
    EXPECT_GT(Large.Walked, One.Walked);
  }
}

TEST(Render, NothingToSeeIsTheBackground) {
  Options O;
  O.Background = {0.1, 0.2, 0.3};
  Gaussians<double> Behind;
  addRound(Behind, {0, 0, -2}, 0.1, 0.8, {1, 1, 1});
  for (const auto &G : {Gaussians<double>(), Behind}) {
    const auto P = renderRound(G, O);
    EXPECT_EQ(P.Render[at(5, 5)], glm::dvec3(0.1, 0.2, 0.3));
    EXPECT_EQ(P.Blends, 0U);
    EXPECT_EQ(P.doubtfulShare(), 0);
  }
}

} // namespace
