#include "scene/Axes.h"
#include "scene/testing/SceneWriters.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Vec3 = std::array<double, 3>;
using Mat3 = std::array<Vec3, 3>;

Mat3 rotationOf(const float *Q) {
  const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  return {
      {{1 - 2 * (Y * Y + Z * Z), 2 * (X * Y - W * Z), 2 * (X * Z + W * Y)},
       {2 * (X * Y + W * Z), 1 - 2 * (X * X + Z * Z), 2 * (Y * Z - W * X)},
       {2 * (X * Z - W * Y), 2 * (Y * Z + W * X), 1 - 2 * (X * X + Y * Y)}}};
}

/// Colour of Gaussian \p I from direction \p D, one channel; polynomials
/// without their factors, which mirroring leaves alone.
double colorOf(const Scene &S, std::size_t I, const Vec3 &D) {
  const auto [X, Y, Z] = D;
  const double Basis[16] = {1,
                            -Y,
                            Z,
                            -X,
                            X * Y,
                            -Y * Z,
                            2 * Z * Z - X * X - Y * Y,
                            -X * Z,
                            X * X - Y * Y,
                            -Y * (3 * X * X - Y * Y),
                            X * Y * Z,
                            -Y * (4 * Z * Z - X * X - Y * Y),
                            Z * (2 * Z * Z - 3 * X * X - 3 * Y * Y),
                            -X * (4 * Z * Z - X * X - Y * Y),
                            Z * (X * X - Y * Y),
                            -X * (X * X - 3 * Y * Y)};
  double Sum = 0;
  for (std::size_t K = 0; K < S.coefficients(); ++K)
    Sum += Basis[K] * S.Sh[3 * (S.coefficients() * I + K)];
  return Sum;
}

TEST(Axes, AMirroredSceneLooksTheSameFromTheMirroredPlace) {
  for (const char *To : {"rub", "luf", "ruf", "ldf", "rdb", "lub", "rdf"}) {
    const Scene Before = randomScene(10, 3, 6);
    Scene After = Before;
    const auto Change = parseAxesChange("--axes", std::string("rdf:") + To);
    ASSERT_TRUE(Change);
    changeAxes(After, *Change);
    double F[3];
    for (std::size_t A = 0; A < 3; ++A)
      F[A] = Change->From[A] * Change->To[A];
    const Vec3 D = {0.36, -0.48, 0.8};
    const Vec3 Mirrored = {F[0] * D[0], F[1] * D[1], F[2] * D[2]};
    for (std::size_t I = 0; I < Before.size(); ++I) {
      EXPECT_NEAR(colorOf(After, I, Mirrored), colorOf(Before, I, D), 1e-12);
      const Mat3 R = rotationOf(&Before.Quats[4 * I]),
                 M = rotationOf(&After.Quats[4 * I]);
      for (std::size_t A = 0; A < 3; ++A) {
        EXPECT_EQ(After.Means[3 * I + A], F[A] * Before.Means[3 * I + A]);
        for (std::size_t B = 0; B < 3; ++B) // column b is an axis, either way
          EXPECT_NEAR(M[A][B], F[A] * R[A][B] * F[B], 1e-6);
      }
    }
    changeAxes(After, {Change->To, Change->From});
    EXPECT_EQ(After.Quats, Before.Quats);
    EXPECT_EQ(After.Sh, Before.Sh);
  }
}

TEST(Axes, OnlyThreeDirectionsAreTaken) {
  EXPECT_EQ(*parseAxes("--axes", "rub"), (Axes{1, 1, -1}));
  for (const char *Text : {"", "rd", "rdff", "urf", "rdx"}) {
    const auto A = parseAxes("--axes", Text);
    ASSERT_FALSE(A) << Text;
    EXPECT_EQ(A.error().Code, ExitCode::Usage);
  }
  EXPECT_FALSE(parseAxesChange("--axes", "rub"));
  EXPECT_FALSE(parseAxesChange("--axes", "rub:xyz"));
}

} // namespace
