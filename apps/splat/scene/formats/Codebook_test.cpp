#include "scene/formats/Codebook.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

using namespace vorion::splat;

namespace {

/// From -1 to 1, the same on every host.
class Numbers {
public:
  float next() {
    return static_cast<float>(double(Random() >> 8) / (1 << 23) - 1);
  }

private:
  std::mt19937 Random{7};
};

TEST(Codebook, FewValuesAreKept) {
  const auto Book = codebookOf({3, -1, 3, 0.5F, -1});
  EXPECT_EQ(Book[0], -1);
  EXPECT_EQ(Book[1], 0.5);
  EXPECT_EQ(Book[2], 3);
  EXPECT_EQ(Book[255], 3);
  EXPECT_TRUE(std::ranges::is_sorted(Book));
  EXPECT_EQ(nearestIn(Book, 0.5), 1);
  EXPECT_EQ(nearestIn(Book, -9), 0);
  EXPECT_EQ(Book[nearestIn(Book, 99)], 3);
  EXPECT_EQ(nearestIn(Book, -0.26), 0);
  EXPECT_EQ(nearestIn(Book, -0.24), 1);
}

/// Compared with even steps, as older formats have them.
TEST(Codebook, ItIsNearerThanEvenStepsWhereValuesCrowd) {
  Numbers N;
  std::vector<float> Values;
  for (int I = 0; I < 20000; ++I)
    Values.push_back(std::pow(N.next(), 5.0F));
  const auto Book = codebookOf(Values);
  double Ours = 0, Even = 0, Worst = 0;
  for (const float V : Values) {
    const double D = V - Book[nearestIn(Book, V)];
    Ours += D * D;
    Worst = std::max(Worst, std::abs(D));
    const double E = V - (std::round((V + 1) * 127.5) / 127.5 - 1);
    Even += E * E;
  }
  EXPECT_LT(Ours, 0.6 * Even);
  EXPECT_LT(Worst, 0.02);
}

TEST(Codebook, TheOrderOfTheValuesDoesNotMatter) {
  Numbers N;
  std::vector<float> Values;
  for (int I = 0; I < 3000; ++I)
    Values.push_back(N.next());
  const auto Book = codebookOf(Values);
  std::ranges::reverse(Values);
  EXPECT_EQ(codebookOf(Values), Book);
}

TEST(Codebook, SmallPalettesAreTheVectorsThemselves) {
  const std::vector<float> Vectors{1, 2, 3, 4, 5, 6};
  const VectorPalette P = paletteOf(Vectors, 2, 3);
  EXPECT_EQ(P.Entries, Vectors);
  EXPECT_EQ(P.Labels, (std::vector<uint32_t>{0, 1, 2}));
}

TEST(Codebook, PalettesFindTheGroups) {
  // 40 points in space, each 25 times with a little noise.
  Numbers N;
  std::vector<float> Middles;
  for (int I = 0; I < 120; ++I)
    Middles.push_back(N.next());
  std::vector<float> Vectors;
  for (int I = 0; I < 1000; ++I)
    for (int K = 0; K < 3; ++K)
      Vectors.push_back(Middles[I % 40 * 3 + K] + 1e-4F * N.next());
  const VectorPalette P = paletteOf(Vectors, 3, 40);
  ASSERT_EQ(P.Entries.size(), 120U);
  ASSERT_EQ(P.Labels.size(), 1000U);
  for (int I = 0; I < 1000; ++I)
    for (int K = 0; K < 3; ++K)
      EXPECT_NEAR(P.Entries[3 * P.Labels[I] + K], Vectors[3 * I + K], 3e-4);
}

TEST(Codebook, EqualAndNearlyEqualVectorsEnd) {
  const VectorPalette P = paletteOf(std::vector<float>(3000, 0.1F), 3, 7);
  EXPECT_EQ(P.Entries.size(), 3U);
  std::vector<float> Nearly(3000, 1);
  for (std::size_t I = 0; I < Nearly.size(); I += 7)
    Nearly[I] = std::nextafter(1.0F, 2.0F);
  EXPECT_LE(paletteOf(Nearly, 3, 7).Entries.size(), 21U);
}

} // namespace
