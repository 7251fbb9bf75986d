#include "train/Neighbours.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

namespace vorion::splat {
namespace {

/// A k-d tree without nodes: a range of \c Order is split at its middle, whose
/// point separates the halves along the axis in which the range is longest.
class Tree {
public:
  explicit Tree(const std::vector<float> &Points)
      : Points(Points), Order(Points.size() / 3), Axes(Order.size()) {
    std::iota(Order.begin(), Order.end(), 0U);
    split(0, Order.size());
  }

  /// Squared distances to the nearest ones, rising, into \p Best, which has
  /// room for those wanted and starts with infinities.
  void nearest(uint32_t To, std::vector<double> &Best) const {
    search(To, 0, Order.size(), Best);
  }

private:
  /// Ranges that are gone through one by one.
  static constexpr std::size_t Leaf = 8;

  double at(uint32_t Point, std::size_t Axis) const {
    return Points[3 * std::size_t{Point} + Axis];
  }

  void split(std::size_t Begin, std::size_t End) {
    if (End - Begin <= Leaf)
      return;
    std::size_t Longest = 0;
    double Length = -1;
    for (std::size_t A = 0; A < 3; ++A) {
      double Low = at(Order[Begin], A), High = Low;
      for (std::size_t I = Begin; I < End; ++I) {
        Low = std::min(Low, at(Order[I], A));
        High = std::max(High, at(Order[I], A));
      }
      if (High - Low > Length) {
        Length = High - Low;
        Longest = A;
      }
    }
    const std::size_t Middle = (Begin + End) / 2;
    const auto It = [&](std::size_t I) {
      return Order.begin() + static_cast<std::ptrdiff_t>(I);
    };
    std::nth_element(It(Begin), It(Middle), It(End),
                     [&](uint32_t A, uint32_t B) {
                       return at(A, Longest) < at(B, Longest);
                     });
    Axes[Middle] = static_cast<uint8_t>(Longest);
    split(Begin, Middle);
    split(Middle + 1, End);
  }

  void look(uint32_t From, uint32_t Other, std::vector<double> &Best) const {
    if (From == Other)
      return;
    double Squares = 0;
    for (std::size_t A = 0; A < 3; ++A) {
      const double D = at(From, A) - at(Other, A);
      Squares += D * D;
    }
    if (Squares >= Best.back())
      return;
    Best.back() = Squares;
    for (std::size_t I = Best.size() - 1; I > 0 && Best[I] < Best[I - 1]; --I)
      std::swap(Best[I], Best[I - 1]);
  }

  void search(uint32_t To, std::size_t Begin, std::size_t End,
              std::vector<double> &Best) const {
    if (End - Begin <= Leaf) {
      for (std::size_t I = Begin; I < End; ++I)
        look(To, Order[I], Best);
      return;
    }
    const std::size_t Middle = (Begin + End) / 2;
    const std::size_t Axis = Axes[Middle];
    look(To, Order[Middle], Best);
    const double Offset = at(To, Axis) - at(Order[Middle], Axis);
    const bool Right = Offset > 0;
    search(To, Right ? Middle + 1 : Begin, Right ? End : Middle, Best);
    if (Offset * Offset < Best.back())
      search(To, Right ? Begin : Middle + 1, Right ? Middle : End, Best);
  }

  const std::vector<float> &Points;
  std::vector<uint32_t> Order;
  std::vector<uint8_t> Axes;
};

} // namespace

std::vector<double> meanNeighbourDistances(const std::vector<float> &Positions,
                                           std::size_t Count) {
  const std::size_t N = Positions.size() / 3;
  const std::size_t Wanted = std::min(Count, N > 0 ? N - 1 : 0);
  std::vector<double> Means(N, 0);
  if (Wanted == 0)
    return Means;
  const Tree T(Positions);
  std::vector<double> Best;
  for (uint32_t I = 0; I < N; ++I) {
    Best.assign(Wanted, std::numeric_limits<double>::infinity());
    T.nearest(I, Best);
    for (const double Squares : Best)
      Means[I] += std::sqrt(Squares);
    Means[I] /= static_cast<double>(Wanted);
  }
  return Means;
}

} // namespace vorion::splat
