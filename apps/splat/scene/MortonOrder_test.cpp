#include "scene/MortonOrder.h"
#include "scene/testing/SceneWriters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <set>

using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

/// All that a scene has of Gaussian \p I.
std::vector<float> recordOf(const Scene &S, std::size_t I) {
  std::vector<float> Record;
  for (const auto &[Values, Each] : {std::pair(&S.Means, std::size_t{3}),
                                     {&S.LogScales, 3},
                                     {&S.Quats, 4},
                                     {&S.OpacityLogits, 1},
                                     {&S.Sh, 3 * S.coefficients()}})
    Record.insert(
        Record.end(), Values->begin() + static_cast<std::ptrdiff_t>(I * Each),
        Values->begin() + static_cast<std::ptrdiff_t>((I + 1) * Each));
  return Record;
}

std::multiset<std::vector<float>> recordsOf(const Scene &S) {
  std::multiset<std::vector<float>> Records;
  for (std::size_t I = 0; I < S.size(); ++I)
    Records.insert(recordOf(S, I));
  return Records;
}

/// Where the mean of \p I is in a cube at \p Low: by halving it \p Depth times
/// an octant each, z first. Such lists compare as the curve goes.
std::vector<int> octantsOf(const Scene &S, std::size_t I,
                           std::array<double, 3> Low, double Length) {
  std::vector<int> Octants;
  for (int Depth = 0; Depth < 12; ++Depth) {
    Length /= 2;
    int Octant = 0;
    for (std::size_t A = 3; A-- > 0;) {
      const bool Upper = S.Means[3 * I + A] >= Low[A] + Length;
      Octant = 2 * Octant + Upper;
      Low[A] += Upper ? Length : 0;
    }
    Octants.push_back(Octant);
  }
  return Octants;
}

Scene sceneAt(const std::vector<float> &Means) {
  Scene S = randomScene(Means.size() / 3, 1, 8);
  S.Means = Means;
  return S;
}

TEST(MortonOrder, HasTheSameGaussians) {
  const Scene Before = randomScene(500, 2, 6);
  Scene After = Before;
  EXPECT_GT(putInMortonOrder(After), 400);
  EXPECT_EQ(After.ShDegree, 2);
  EXPECT_EQ(recordsOf(Before), recordsOf(After));
}

TEST(MortonOrder, GoesThroughOctantsOfOctants) {
  Scene S = randomScene(500, 0, 7);
  for (std::size_t I = 0; I < S.size(); ++I)
    S.Means[3 * I + 1] *= 0.01F; // axes of other lengths: the cells are cubes
  // The cube's sides are hit exactly.
  std::array<double, 3> Low{};
  double Length = 0;
  for (std::size_t A = 0; A < 3; ++A) {
    double Least = S.Means[A], Most = S.Means[A];
    for (std::size_t I = 0; I < S.size(); ++I) {
      Least = std::min<double>(Least, S.Means[3 * I + A]);
      Most = std::max<double>(Most, S.Means[3 * I + A]);
    }
    Low[A] = Least;
    Length = std::max(Length, Most - Least);
  }
  // The last of 2^21 steps has the far side alone, so a cell is wider by one.
  Length *= 2097152.0 / 2097151.0;
  putInMortonOrder(S);
  for (std::size_t I = 1; I < S.size(); ++I)
    ASSERT_LE(octantsOf(S, I - 1, Low, Length), octantsOf(S, I, Low, Length))
        << I;
}

TEST(MortonOrder, XChangesFastest) {
  Scene S = sceneAt({1, 1, 1, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0, 0, 0});
  putInMortonOrder(S);
  EXPECT_EQ(S.Means,
            (std::vector<float>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1}));
}

TEST(MortonOrder, KeepsTheOrderOfOnePlace) {
  Scene S = randomScene(200, 0, 9);
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t A = 0; A < 3; ++A)
      S.Means[3 * I + A] = I % 3 == A ? 1 : 0;
    S.OpacityLogits[I] = static_cast<float>(I);
  }
  putInMortonOrder(S);
  for (std::size_t I = 1; I < S.size(); ++I)
    if (std::equal(&S.Means[3 * I], &S.Means[3 * I] + 3, &S.Means[3 * I - 3]))
      EXPECT_GT(S.OpacityLogits[I], S.OpacityLogits[I - 1]);
}

TEST(MortonOrder, MovesNothingTwice) {
  Scene S = randomScene(500, 1, 10);
  putInMortonOrder(S);
  const Scene Once = S;
  EXPECT_EQ(putInMortonOrder(S), 0);
  EXPECT_EQ(S.Means, Once.Means);
  EXPECT_EQ(S.Sh, Once.Sh);
}

TEST(MortonOrder, HoldsAtTheEndsOfTheRange) {
  Scene Empty;
  EXPECT_EQ(putInMortonOrder(Empty), 0);
  Scene Point = sceneAt({2, 2, 2, 2, 2, 2});
  EXPECT_EQ(putInMortonOrder(Point), 0);
  constexpr float Most = std::numeric_limits<float>::max();
  Scene Wide = sceneAt({Most, 0, 0, -Most, 0, 0, 0, 0, 0});
  EXPECT_EQ(putInMortonOrder(Wide), 3);
  EXPECT_EQ(Wide.Means, (std::vector<float>{-Most, 0, 0, 0, 0, 0, Most, 0, 0}));
}

} // namespace
