/// What a unit has asked memory for and waits for.
#pragma once

#include "timing/common/Turn.h"
#include "timing/memory/MemorySystem.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Sets of lines. A set is ready when its last line has come or been taken.
class LineWaits {
public:
  LineWaits(MemoryPort PortIn, unsigned Count)
      : Port(PortIn), Sets(std::bit_ceil(Count)) {
    for (uint32_t N = 0; N != Sets.size(); ++N)
      Sets[N].Tag = N;
  }

  /// Set \p N is empty from now on, and ready at \p Now: what is still to come
  /// for it is nobody's any more.
  void begin(unsigned N, uint64_t Now = 0) {
    Set &S = Sets[N];
    S = {(S.Tag + static_cast<uint32_t>(Sets.size())) & TagMask, 0, {Now}};
  }
  /// A line of set \p N is asked for elsewhere: answer() says when it comes, by
  /// the tag that this returns.
  uint32_t expect(unsigned N) {
    ++Sets[N].Open;
    return Sets[N].Tag;
  }
  /// Asks for a line of set \p N.
  void ask(MemorySystem &Memory, unsigned N, CacheRequest &R) {
    Set &S = Sets[N];
    R.From = {Port.Unit, S.Tag};
    if (const auto Then = Memory.access(Port, R))
      S.come(*Then);
    else
      ++S.Open;
  }
  /// A line of set \p N is there at \p Then, and nobody has to be asked.
  void add(unsigned N, const Arrival &Then) { Sets[N].come(Then); }
  /// When set \p N is ready; Turn::Never if that is not known yet.
  uint64_t readyAt(unsigned N) const {
    return Sets[N].Open ? Turn::Never : Sets[N].Last.At;
  }
  /// The first of the first \p Count sets to be ready.
  unsigned firstOf(unsigned Count) const {
    unsigned First = 0;
    uint64_t Earliest = readyAt(0);
    for (unsigned N = 1; N < Count; ++N) {
      const uint64_t Then = readyAt(N);
      First = Then < Earliest ? N : First;
      Earliest = std::min(Earliest, Then);
    }
    return First;
  }
  /// Likewise, with how its last line came.
  const Arrival &arrivalOf(unsigned N) const {
    return Sets[N].Open ? Unknown : Sets[N].Last;
  }
  /// An answer of memory; returns the set that is known by it.
  std::optional<unsigned> answer(const Answer &A) {
    const auto N = static_cast<unsigned>(A.To.Tag & (Sets.size() - 1));
    Set &S = Sets[N];
    if (S.Tag != A.To.Tag)
      return std::nullopt;
    S.come(A.arrival());
    if (--S.Open != 0)
      return std::nullopt;
    return N;
  }

  /// Tags are no larger.
  static constexpr uint32_t TagMask = (1U << 30) - 1;

private:
  static constexpr Arrival Unknown{Turn::Never};
  struct Set {
    uint32_t Tag = 0; ///< the set's number, and how often it began
    uint32_t Open = 0;
    Arrival Last;

    void come(const Arrival &Then) {
      if (Then.At > Last.At)
        Last = Then;
    }
  };
  MemoryPort Port;
  std::vector<Set> Sets;
};

} // namespace vorion::isasim
