/// SplitMix64 (Steele, Lea and Flood, OOPSLA 2014), a generator of random
/// numbers whose state is a counter.
#pragma once

#include <cstdint>

namespace vorion::splitmix {

inline constexpr uint64_t Step = 0x9e3779b97f4a7c15;

/// Mixes the bits of a state, or of a number that is to become one.
constexpr uint64_t mix(uint64_t X) {
  X = (X ^ (X >> 30)) * 0xbf58476d1ce4e5b9;
  X = (X ^ (X >> 27)) * 0x94d049bb133111eb;
  return X ^ (X >> 31);
}

/// The next 64 bits of the sequence of \p State.
constexpr uint64_t next(uint64_t &State) { return mix(State += Step); }

} // namespace vorion::splitmix
