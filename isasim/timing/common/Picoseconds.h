/// Cycles of a clock, and time that several clocks share.
#pragma once

#include <cstdint>

namespace vorion::isasim {

/// A cycle has so many ps times MHz.
inline constexpr uint64_t PsTimesMhz = 1000000;

constexpr uint64_t quotientUp(uint64_t A, uint64_t B) {
  return (A + B - 1) / B;
}

/// When \p Cycle begins. Rounded down, so that cycleOf() gives it back.
constexpr uint64_t psOf(uint64_t Cycle, uint64_t Mhz) {
  return Cycle * PsTimesMhz / Mhz;
}
/// The first cycle that does not begin before \p Ps.
constexpr uint64_t cycleOf(uint64_t Ps, uint64_t Mhz) {
  return quotientUp(Ps * Mhz, PsTimesMhz);
}

} // namespace vorion::isasim
