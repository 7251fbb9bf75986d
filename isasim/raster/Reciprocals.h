/// The numbers of the units for 1 / (1 - alpha) that vr_backward.reciprocal
/// chooses between (paper, "Training"). Their code is in ReciprocalVector.h;
/// what they are and cost is in intrinsics/Units.td.
#pragma once

namespace vorion::raster {

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
