// That the records agree with each other, and each equation with its way back.

#include "lens/Lenses.h"
#include "lens/Models.h"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

namespace vorion::splat {
namespace {

TEST(Lenses, EveryNameIsOfOneModel) {
  std::set<std::string_view> Names, Keys;
  std::set<int> Ids;
  for (const LensModel *M : lenses::all()) {
    EXPECT_EQ(lensModelNamed(M->Name), M);
    for (const auto &Own : {M->Names, M->OtherNames})
      for (const std::string_view Name : Own) {
        EXPECT_TRUE(Names.insert(Name).second) << Name;
        EXPECT_EQ(lensModelNamed(Name), M) << Name;
      }
    for (const ColmapLens &C : M->Colmap) {
      EXPECT_TRUE(Ids.insert(C.Id).second) << C.Name;
      EXPECT_EQ(lensModelNamed(C.Name), M) << C.Name;
      EXPECT_LE(C.Coefficients, M->Keys.size()) << C.Name;
    }
    if (!M->isPinhole())
      EXPECT_TRUE(Keys.insert(M->Macro).second) << M->Name;
    EXPECT_EQ(M->isPinhole(), M->EffectName.empty()) << M->Name;
    EXPECT_LE(M->Keys.size(), LensCoefficients().size()) << M->Name;
  }
  EXPECT_EQ(lensModelNamed("Simple_Pinhole"), &lenses::Pinhole);
  EXPECT_EQ(lensModelNamed(""), nullptr);
  EXPECT_EQ(lensModelOfViewer("perspective"), &lenses::Pinhole);
  EXPECT_EQ(lensModelOfViewer(""), nullptr);
}

/// Some of both signs that keep a model one to one around the middle.
LensCoefficients someOf(const LensModel &M) {
  LensCoefficients K{};
  if (&M == &lenses::Eucm)
    return {0.6, 1.2};
  for (std::size_t I = 0; I < M.Keys.size(); ++I)
    K[I] = (I % 2 == 0 ? -0.05 : 0.02) / static_cast<double>(1 + I);
  return K;
}

TEST(Lenses, RaysAreTheWayBackOfDistorting) {
  for (const LensModel *M : lenses::all()) {
    if (M->IsParallel || M->CoversSphere)
      continue;
    const LensCoefficients K = someOf(*M);
    for (const double X : {-0.4, 0.0, 0.7})
      for (const double Y : {0.0, 0.5}) {
        const auto [U, V] = M->Distorted(*M, K, X, Y);
        const auto Ray = M->Ray(K, U, V);
        ASSERT_TRUE(Ray) << M->Name;
        EXPECT_NEAR((*Ray)[0] / (*Ray)[2], X, 1e-9) << M->Name;
        EXPECT_NEAR((*Ray)[1] / (*Ray)[2], Y, 1e-9) << M->Name;
      }
    for (const double R : {0.1, 0.5, 0.9})
      EXPECT_NEAR(undistortedRadius(*M, K, M->Radius(K, R)), R, 1e-9)
          << M->Name;
  }
}

// Of a point so far beside the ray along both vectors: at right angles to it,
// or in the plane at its depth.
TEST(Lenses, FramesMeasureFromTheRay) {
  for (const LensModel *M : lenses::all()) {
    if (M->IsParallel)
      continue;
    const LensCoefficients K = someOf(*M);
    const auto Ray = M->Ray(K, 0.3, -0.2);
    ASSERT_TRUE(Ray) << M->Name;
    EXPECT_NEAR(std::hypot((*Ray)[0], (*Ray)[1], (*Ray)[2]), 1, 1e-12)
        << M->Name;
    const RayFrame F = M->Frame(*Ray, 0.3, -0.2);
    for (const auto &Beside : F.Beside) {
      double Along = 0;
      for (std::size_t I = 0; I < 3; ++I)
        Along += Beside[I] * (*Ray)[I];
      EXPECT_NEAR(Along, 0, 1e-12) << M->Name;
    }
    EXPECT_EQ(F.Start, (LensPlace{})) << M->Name;
  }
}

} // namespace
} // namespace vorion::splat
