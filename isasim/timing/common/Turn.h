/// When a unit of the clock goes on.
#pragma once

#include <cstdint>

namespace vorion::isasim {

/// The next thing that a unit does and others can notice. One word whose upper
/// part is the time, since every step of the clock looks for the first of all.
struct Turn {
  static constexpr uint64_t Never = UINT64_MAX >> 1;

  /// It is done at At. Otherwise it is not known yet what comes, only that it
  /// is not before At.
  uint64_t IsKnown : 1;
  uint64_t At : 63;

  constexpr explicit Turn(uint64_t AtIn = Never, bool IsKnownIn = true)
      : IsKnown(IsKnownIn), At(AtIn) {}

  /// In the order of time: what is not known yet may have to be first.
  constexpr bool operator<(Turn Other) const { return word() < Other.word(); }
  constexpr bool operator==(Turn Other) const { return word() == Other.word(); }

private:
  /// As it lies in memory: this costs nothing.
  constexpr uint64_t word() const { return At << 1 | IsKnown; }
};
static_assert(Turn(7, true) < Turn(8, false) && Turn(8, false) < Turn(8));

} // namespace vorion::isasim
