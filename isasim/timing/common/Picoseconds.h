/// Cycles of a clock, and time that several clocks share.
#pragma once

#include <bit>
#include <cstdint>

namespace vorion::isasim {

/// A cycle has so many ps times MHz.
inline constexpr uint64_t PsTimesMhz = 1000000;

constexpr uint64_t quotientUp(uint64_t A, uint64_t B) {
  return (A + B - 1) / B;
}

/// Divides numbers below 2^63 by one that is below 2^63, which takes the host a
/// multiplication: rounding errors of a factor of 64 bits stay below the last.
class Divisor {
public:
  constexpr explicit Divisor(uint64_t ByIn)
      : By(ByIn), Shift(63U + static_cast<unsigned>(std::bit_width(By - 1))),
        Factor(static_cast<uint64_t>((Wide{1} << Shift) / By + 1)) {}

  constexpr uint64_t down(uint64_t N) const {
    return static_cast<uint64_t>(Wide{N} * Factor >> Shift);
  }
  constexpr uint64_t up(uint64_t N) const { return down(N + By - 1); }

private:
  __extension__ using Wide = unsigned __int128;
  uint64_t By;
  unsigned Shift;
  uint64_t Factor;
};
static_assert(Divisor(3).down(uint64_t{INT64_MAX}) == INT64_MAX / 3 &&
              Divisor(530).up(530 * 7 + 1) == 8 && Divisor(1).down(9) == 9);

/// When \p Cycle begins. Rounded down, so that cycleOf() gives it back.
constexpr uint64_t psOf(uint64_t Cycle, uint64_t Mhz) {
  return Cycle * PsTimesMhz / Mhz;
}
/// The first cycle that does not begin before \p Ps.
constexpr uint64_t cycleOf(uint64_t Ps, uint64_t Mhz) {
  return quotientUp(Ps * Mhz, PsTimesMhz);
}

} // namespace vorion::isasim
