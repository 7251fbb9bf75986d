/// What a unit spent its cycles on, cut at the ends of runs.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>

namespace vorion::isasim {

/// A unit knows what it will do for some cycles ahead, and its work may outlive
/// the run that started it; a run's report has the cycles of the run alone.
/// \p Reason is an enumeration that ends in Count.
template <typename Reason> class CycleLedger {
public:
  /// Is told what has been counted, from and until when, in the order of time.
  using Listener = std::function<void(Reason, uint64_t, uint64_t)>;
  using Sums = std::array<uint64_t, size_t(Reason::Count)>;

  /// \p To may be null.
  void listen(Listener To) { Told = std::move(To); }

  /// All before \p Now has been reported or was spent on nothing.
  void begin(uint64_t Now) { Position = std::max(Position, Now); }

  /// The cycles from the last spend() until \p Until go to \p What.
  void spend(Reason What, uint64_t Until) {
    if (!Ahead.empty() && Ahead.back().What == What)
      Ahead.back().Until = Until;
    else
      Ahead.push_back({What, Until});
  }

  /// No run ends before \p Now: keeps the rest short.
  void settle(uint64_t Now) {
    while (!Ahead.empty() && Ahead.front().Until <= Now) {
      count(Ahead.front().What, Ahead.front().Until);
      Ahead.pop_front();
    }
  }

  /// A run ends at \p End: its sums, where cycles that nobody has spent yet go
  /// to \p Rest.
  Sums end(uint64_t End, Reason Rest) {
    settle(End);
    count(Ahead.empty() ? Rest : Ahead.front().What, End);
    const Sums All = Counted;
    Counted = {};
    return All;
  }

  /// Forgets all that lies ahead.
  void clear() { Ahead.clear(); }

private:
  struct Spent {
    Reason What;
    uint64_t Until;
  };
  void count(Reason What, uint64_t Until) {
    if (Until <= Position)
      return;
    Counted[size_t(What)] += Until - Position;
    if (Told)
      Told(What, Position, Until);
    Position = Until;
  }

  std::deque<Spent> Ahead;
  uint64_t Position = 0; ///< all before is in Counted
  Sums Counted{};
  Listener Told;
};

} // namespace vorion::isasim
