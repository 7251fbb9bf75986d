#include "scene/MortonOrder.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <utility>
#include <vector>

namespace vorion::splat {
namespace {

/// Three axes of so many bits are one word.
constexpr unsigned Bits = 21;

/// Bit i of \p Step as bit 3 i of the result.
uint64_t spread(uint64_t Step) {
  uint64_t Result = 0;
  for (unsigned Bit = 0; Bit < Bits; ++Bit)
    Result |= (Step >> Bit & 1) << (3 * Bit);
  return Result;
}

std::vector<uint64_t> placesOf(const Scene &S) {
  std::array<double, 3> Low{};
  // One length for all axes makes cells cubes, and cubes hold near neighbours.
  double Length = 0;
  for (std::size_t A = 0; A < 3; ++A) {
    double Least = S.mean(A), Most = S.mean(A);
    for (std::size_t I = 0; I < S.size(); ++I) {
      Least = std::min(Least, S.mean(3 * I + A));
      Most = std::max(Most, S.mean(3 * I + A));
    }
    Low[A] = Least;
    Length = std::max(Length, Most - Least);
  }
  std::vector<uint64_t> Places(S.size());
  if (Length > 0)
    for (std::size_t I = 0; I < S.size(); ++I)
      for (std::size_t A = 0; A < 3; ++A) {
        const double T = (S.mean(3 * I + A) - Low[A]) / Length;
        Places[I] |= spread(static_cast<uint64_t>(T * ((1U << Bits) - 1))) << A;
      }
  return Places;
}

} // namespace

std::size_t putInMortonOrder(Scene &S) {
  if (S.size() == 0)
    return 0;
  const std::vector<uint64_t> Places = placesOf(S);
  std::vector<std::size_t> Order(S.size());
  std::iota(Order.begin(), Order.end(), std::size_t{0});
  std::ranges::sort(Order, [&](std::size_t A, std::size_t B) {
    return std::pair(Places[A], A) < std::pair(Places[B], B);
  });
  Scene Result = Scene::sized(S.size(), S.ShDegree);
  std::size_t Moved = 0;
  for (std::size_t To = 0; To < Order.size(); ++To) {
    copy(S, Order[To], 1, Result, To);
    Moved += Order[To] != To;
  }
  S = std::move(Result);
  return Moved;
}

} // namespace vorion::splat
