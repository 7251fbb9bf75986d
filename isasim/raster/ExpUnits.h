/// The exponential units that vr_options.exp chooses between. Their code is
/// in ExpVector.h; here is what each is, for reports, the timing model and
/// tests.
#pragma once

#include "raster/RasterTables.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::raster {

/// What an exponential unit is and costs, per lane. Latency and multipliers
/// are our estimates of a plausible build (the paper gives none).
struct ExpUnit {
  std::uint32_t Option; ///< value of vr_options.exp
  std::string_view Name;
  unsigned LatencyCycles;
  unsigned TableBits;
  std::string_view Multipliers;
  double MaxRelativeError;      ///< bound for results of at least 2^-125
  std::string_view Explanation; ///< one sentence for `--explain`
};

/// How many there are: options 0 to ExpUnitCount - 1.
inline constexpr std::size_t ExpUnitCount = 2;

/// The units that exist, by option; any other option is VR_BAD_MODE.
std::span<const ExpUnit> expUnits();

/// Numbers of the table unit: exp(p) = 2^-y; y in fixed point has a whole part,
/// the number of a table entry, and a rest that interpolates to the next entry.
namespace table_exp {
inline constexpr int FractionBits = 16;
inline constexpr int EntryBits = 4;
inline constexpr int RestBits = FractionBits - EntryBits;
inline constexpr int Entries = 1 << EntryBits;
/// log2(e) * 2^16, as a float.
inline constexpr float Log2EFixed = 0x1.715476p16F;
/// Results below 2^-126 are 0: no subnormal numbers in the unit.
inline constexpr int SmallestExponent = 126;
/// |p| is held at this, beyond which every result is 0.
inline constexpr float Largest = 90.0F;

inline constexpr int StartBits = 17;
inline constexpr int DropBits = 12;

/// Entry i: its start 2^(-i/16) * 2^16, rounded, above DropBits bits of the
/// drop from there to the next entry's start.
struct Segments {
  std::int32_t Words[Entries];
};

constexpr std::int32_t nearest(double Positive) {
  const auto Down = static_cast<std::int32_t>(Positive);
  return Positive - Down < 0.5 ? Down : Down + 1;
}

/// Square roots of 1/2 by Newton's method give 2^(-1/16) at compile time.
constexpr Segments makeSegments() {
  double Step = 0.5;
  for (int I = 0; I != EntryBits; ++I) {
    double Root = 1.0;
    for (int N = 0; N != 40; ++N)
      Root = 0.5 * (Root + Step / Root);
    Step = Root;
  }
  Segments S{};
  double Value = 1 << FractionBits;
  for (int I = 0; I != Entries; ++I) {
    const auto Here = nearest(Value);
    Value *= Step;
    S.Words[I] = Here << DropBits | (Here - nearest(Value));
  }
  return S;
}
inline constexpr Segments Table = makeSegments();
} // namespace table_exp

} // namespace vorion::raster
