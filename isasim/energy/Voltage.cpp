#include "energy/Stable.h"
#include "vorion/isasim/Energy.h"

namespace vorion::isasim {

namespace {

/// (V - threshold)^Alpha / V, the law without its factor.
double speedOf(const Technology &T, double Threshold, double Volts) {
  return Volts <= Threshold ? 0
                            : stable::pow(Volts - Threshold, T.Alpha) / Volts;
}

/// So that the law goes through both points; 0 if it needs none.
double thresholdOf(const Technology &T) {
  // With u the ratio of the two (V - threshold): u^Alpha = wanted.
  const double Wanted = T.HighMhz / T.LowMhz * T.HighVolts / T.LowVolts;
  const double Ratio = stable::pow(Wanted, 1 / T.Alpha);
  if (Ratio <= T.HighVolts / T.LowVolts)
    return 0;
  return (Ratio * T.LowVolts - T.HighVolts) / (Ratio - 1);
}

} // namespace

double clockAt(const Technology &T, double Volts) {
  const double Threshold = thresholdOf(T);
  return T.HighMhz * speedOf(T, Threshold, Volts) /
         speedOf(T, Threshold, T.HighVolts);
}

std::optional<double> voltsFor(const Technology &T, double Mhz) {
  if (Mhz > T.HighMhz)
    return std::nullopt;
  // Below its first point the law is not asked: memories need a voltage.
  double Low = T.LowVolts, High = T.HighVolts;
  if (Mhz == T.HighMhz)
    return High;
  if (Mhz <= clockAt(T, Low))
    return Low;
  for (int N = 0; N != 60; ++N) {
    const double Middle = (Low + High) / 2;
    (clockAt(T, Middle) < Mhz ? Low : High) = Middle;
  }
  return High;
}

} // namespace vorion::isasim
