/// The turns of all units, of which the clock does the first.
#pragma once

#include "timing/common/Turn.h"

#include <bit>
#include <cstddef>
#include <vector>

namespace vorion::isasim {

/// A tree of the first of two, up to the first of all: a change is compared
/// with as many as there are bits in the number of units, or fewer.
class Turns {
public:
  /// Of \p Count units; never.
  void assign(size_t CountIn) {
    Count = CountIn;
    Leaves = std::bit_ceil(Count);
    When.assign(2 * Leaves, Turn());
    Who.resize(2 * Leaves);
    for (size_t N = 0; N != Leaves; ++N)
      Who[Leaves + N] = static_cast<unsigned>(N);
    for (size_t N = Leaves - 1; N != 0; --N)
      Who[N] = Who[2 * N];
  }
  size_t size() const { return Count; }
  Turn operator[](size_t Unit) const { return When[Leaves + Unit]; }
  void set(size_t Unit, Turn Then) {
    size_t N = Leaves + Unit;
    When[N] = Then;
    for (N /= 2; N != 0; N /= 2) {
      const size_t First = 2 * N + (When[2 * N + 1] < When[2 * N]);
      if (When[N] == When[First] && Who[N] == Who[First])
        return;
      When[N] = When[First];
      Who[N] = Who[First];
    }
  }
  /// The unit whose turn is the first; of equal ones the lowest.
  unsigned first() const { return Who[1]; }

private:
  size_t Count = 0, Leaves = 1;
  // Of the first of two, and behind them of the units.
  std::vector<Turn> When;
  std::vector<unsigned> Who;
};

} // namespace vorion::isasim
