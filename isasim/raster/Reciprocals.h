/// The units for 1 / (1 - alpha) that vr_backward.reciprocal chooses between
/// (paper, "Training"). Their code is in ReciprocalVector.h; here are their
/// numbers, and what each is, for reports, the timing model and tests.
#pragma once

#include "raster/RasterTables.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace vorion::raster {

enum class Reciprocal : std::uint8_t {
  Exact,
  EvenLeft,  ///< the paper's, table spaced evenly in alpha, seeds at its left
  EvenBest,  ///< the same, seeds with the least error of an interval
  LogLeft,   ///< the paper's, table spaced evenly in log(1 - alpha)
  LogBest,   ///< the same, best seeds
  Mantissa2, ///< one table for all alpha, indexed by the mantissa; 2 steps
  Mantissa3, ///< the same, 3 steps
};

/// How many there are: options 0 to ReciprocalCount - 1.
inline constexpr std::size_t ReciprocalCount = 7;

/// What a unit is and costs, a pair of lanes (in um^2: timing/DatapathUnits.h).
/// Latency and multipliers are our estimates of a plausible build (the paper
/// gives none).
struct ReciprocalUnit {
  std::uint32_t Option; ///< value of vr_backward.reciprocal
  std::string_view Name;
  unsigned LatencyCycles;
  unsigned TableBits;
  unsigned Multipliers;  ///< fp32, so that it takes a pixel a cycle
  std::string_view Cost; ///< in words
  /// Bound over alpha in [1/255, 0.99], rounding included.
  double MaxRelativeError;
  std::string_view Explanation; ///< one sentence for `--explain`
};

/// The units that exist, by option; any other option is VR_BAD_MODE.
std::span<const ReciprocalUnit> reciprocalUnits();

namespace reciprocal_tables {

inline constexpr int Entries = 8;

/// Interval k holds the d = 1 - alpha below k of the thresholds, which fall.
struct Spaced {
  float Thresholds[Entries - 1];
  float Seeds[Entries];
};

/// The paper's range: from alpha = 0.5 to 0.99.
inline constexpr double FirstD = 0.5, LastD = 0.01;

/// The eighth root of FirstD / LastD, by Newton's square roots.
constexpr double logStep() {
  double Step = FirstD / LastD;
  for (int I = 0; I != 3; ++I) {
    double Root = 1;
    for (int N = 0; N != 60; ++N)
      Root = 0.5 * (Root + Step / Root);
    Step = Root;
  }
  return Step;
}

/// A step y (2 - d y) squares the relative error of y, and leaves y too small:
/// the best seed of an interval of d has equal errors at both ends. The left
/// end of an interval of alpha is its largest d.
constexpr Spaced makeSpaced(bool Log, bool Best) {
  Spaced T{};
  double High = FirstD;
  for (int K = 0; K != Entries; ++K) {
    const double Low =
        Log ? High / logStep() : High - (FirstD - LastD) / Entries;
    T.Seeds[K] = static_cast<float>(Best ? 2 / (Low + High) : 1 / High);
    if (K != Entries - 1)
      T.Thresholds[K] = static_cast<float>(Low);
    High = Low;
  }
  return T;
}

/// Best seeds for m in [1 + k/8, 1 + (k+1)/8).
struct Mantissa {
  float Seeds[Entries];
};
constexpr Mantissa makeMantissa() {
  Mantissa T{};
  for (int K = 0; K != Entries; ++K)
    T.Seeds[K] = static_cast<float>(2 / (2 + (2.0 * K + 1) / Entries));
  return T;
}

inline constexpr Spaced EvenLeft = makeSpaced(false, false);
inline constexpr Spaced EvenBest = makeSpaced(false, true);
inline constexpr Spaced LogLeft = makeSpaced(true, false);
inline constexpr Spaced LogBest = makeSpaced(true, true);
inline constexpr Mantissa OfMantissa = makeMantissa();

} // namespace reciprocal_tables
} // namespace vorion::raster
