#include "SphericalHarmonics.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::reference;

namespace {

TEST(SphericalHarmonics, AreOrthonormal) {
  // Gauss-Legendre in z (four nodes are exact to degree 7) and even steps in
  // the angle integrate products up to degree 6 exactly.
  const double Node[2] = {0.33998104358485626, 0.86113631159405258};
  const double Weight[2] = {0.65214515486254614, 0.34785484513745386};
  constexpr int Steps = 16;
  double Gram[16][16] = {};
  for (int I = 0; I < 4; ++I) {
    const double Z = (I < 2 ? 1 : -1) * Node[I % 2];
    for (int J = 0; J < Steps; ++J) {
      const double A = 2 * M_PI * J / Steps;
      const double R = std::sqrt(1 - Z * Z);
      const auto B =
          shBasis(glm::dvec3(R * std::cos(A), R * std::sin(A), Z), 3);
      for (int K = 0; K < 16; ++K)
        for (int L = 0; L < 16; ++L)
          Gram[K][L] += Weight[I % 2] * 2 * M_PI / Steps * B[K] * B[L];
    }
  }
  for (int K = 0; K < 16; ++K)
    for (int L = 0; L < 16; ++L)
      EXPECT_NEAR(Gram[K][L], K == L, 1e-14) << K << ' ' << L;
}

TEST(SphericalHarmonics, DegreeOneIsMinusYZMinusX) {
  const auto B = shBasis(glm::dvec3(0.1, 0.2, 0.3), 1);
  const double C = std::sqrt(3 / (4 * M_PI));
  EXPECT_NEAR(B[1], -0.2 * C, 1e-15);
  EXPECT_NEAR(B[2], 0.3 * C, 1e-15);
  EXPECT_NEAR(B[3], -0.1 * C, 1e-15);
}

TEST(SphericalHarmonics, HigherDegreesAreLeftOut) {
  const glm::dvec3 D(0.6, 0, 0.8);
  for (int Degree = 0; Degree < 3; ++Degree) {
    const auto B = shBasis(D, Degree), Full = shBasis(D, 3);
    for (int K = 0; K < 16; ++K)
      EXPECT_EQ(B[K], K < (Degree + 1) * (Degree + 1) ? Full[K] : 0);
  }
}

TEST(ShColor, NormalisesTheDirectionAndClampsAtZero) {
  const std::vector<glm::dvec3> Sh{
      {0, 1, -10}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}};
  const auto Near = shColor(Sh.data(), 1, glm::dvec3(0, 0, 1));
  const auto Far = shColor(Sh.data(), 1, glm::dvec3(0, 0, 1000));
  EXPECT_EQ(Near, Far);
  EXPECT_NEAR(Near.x, 0.5 + std::sqrt(3 / (4 * M_PI)), 1e-15);
  EXPECT_NEAR(Near.y, 0.5 + std::sqrt(1 / (4 * M_PI)), 1e-15);
  EXPECT_EQ(Near.z, 0);
}

TEST(ShColor, WithoutADirectionOnlyTheConstantCounts) {
  const std::vector<glm::dvec3> Sh{{1, 1, 1}, {9, 9, 9}, {9, 9, 9}, {9, 9, 9}};
  EXPECT_NEAR(shColor(Sh.data(), 1, glm::dvec3(0)).x,
              0.5 + std::sqrt(1 / (4 * M_PI)), 1e-15);
}

} // namespace
