#include "study/ParetoFront.h"

#include <array>
#include <gtest/gtest.h>
#include <numeric>
#include <random>
#include <ranges>
#include <utility>

using namespace vorion::splat;

namespace {

using Figures = std::array<int, 3>;

bool isAsGood(const Figures &A, const Figures &B) {
  return A[0] <= B[0] && A[1] <= B[1] && A[2] <= B[2];
}

/// Numbers of \p All in the order of the figures, the least first.
std::vector<std::size_t> orderOf(const std::vector<Figures> &All) {
  std::vector<std::size_t> Order(All.size());
  std::iota(Order.begin(), Order.end(), std::size_t{0});
  std::ranges::sort(Order, {},
                    [&](std::size_t I) { return std::pair(All[I], I); });
  return Order;
}

TEST(ParetoFront, HasWhatNoOtherPointBeats) {
  std::mt19937 Random(1);
  for (int Trial = 0; Trial < 50; ++Trial) {
    std::vector<Figures> All(40);
    for (Figures &F : All)
      for (int &Value : F)
        Value = static_cast<int>(Random() % 8);
    const auto Beats = [&](std::size_t A, std::size_t B) {
      return isAsGood(All[A], All[B]) && All[A] != All[B];
    };
    std::vector<std::size_t> Front = paretoFront(orderOf(All), Beats);
    std::ranges::sort(Front);
    std::vector<std::size_t> Right;
    for (std::size_t I = 0; I < All.size(); ++I)
      if (std::ranges::none_of(std::views::iota(std::size_t{0}, All.size()),
                               [&](std::size_t J) { return Beats(J, I); }))
        Right.push_back(I);
    EXPECT_EQ(Front, Right);
  }
}

TEST(ParetoFront, TheRelationSaysWhetherEqualPointsStay) {
  const std::vector<Figures> All{{1, 1, 1}, {1, 1, 1}, {2, 0, 1}};
  const auto AsGood = [&](std::size_t A, std::size_t B) {
    return isAsGood(All[A], All[B]);
  };
  EXPECT_EQ(paretoFront(orderOf(All), AsGood),
            (std::vector<std::size_t>{0, 2}));
  const auto Better = [&](std::size_t A, std::size_t B) {
    return AsGood(A, B) && All[A] != All[B];
  };
  EXPECT_EQ(paretoFront(orderOf(All), Better),
            (std::vector<std::size_t>{0, 1, 2}));
  EXPECT_TRUE(paretoFront({}, AsGood).empty());
}

} // namespace
