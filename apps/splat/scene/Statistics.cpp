#include "scene/Statistics.h"

#include "io/Mean.h"
#include "scene/Activation.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace vorion::splat {
namespace {

/// Of what has a finite exponential in double.
constexpr double LargestLog = 700;

/// The value below which a share of \p Values lies; reorders them.
double quantile(std::vector<double> &Values, double Share) {
  const auto At =
      Values.begin() + static_cast<std::ptrdiff_t>(
                           Share * static_cast<double>(Values.size() - 1));
  std::nth_element(Values.begin(), At, Values.end());
  return *At;
}

Distribution spreadOf(std::vector<double> Values) {
  Distribution S;
  S.Mean = meanOf(Values);
  S.Least = *std::min_element(Values.begin(), Values.end());
  S.Largest = *std::max_element(Values.begin(), Values.end());
  S.Median = quantile(Values, 0.5);
  return S;
}

/// A stored byte of 1 is 1/255 but for its logit's rounding.
constexpr double Blended = (1 - 1e-6) / 255;

} // namespace

SceneStatistics statisticsOf(const Scene &S) {
  SceneStatistics R;
  const std::size_t Count = S.size();
  std::vector<double> Values(Count);
  for (std::size_t A = 0; A < 3; ++A) {
    for (std::size_t I = 0; I < Count; ++I)
      Values[I] = S.mean(3 * I + A);
    constexpr double Strays = 0.01;
    R.InnerLow[A] = quantile(Values, Strays);
    R.InnerHigh[A] = quantile(Values, 1 - Strays);
    R.Low[A] = *std::min_element(Values.begin(), Values.end());
    R.High[A] = *std::max_element(Values.begin(), Values.end());
  }

  const auto Active = activate<double>(S);
  R.Opacity = spreadOf(Active.Opacities);
  const auto Unseen =
      std::count_if(Active.Opacities.begin(), Active.Opacities.end(),
                    [](double O) { return O < Blended; });
  R.Transparent = static_cast<double>(Unseen) / static_cast<double>(Count);
  std::vector<double> Ratios(Count);
  for (std::size_t I = 0; I < Count; ++I) {
    const float *Logs = &S.LogScales[3 * I];
    const auto [Short, Long] = std::minmax_element(Logs, Logs + 3);
    Values[I] = std::exp(std::min<double>(*Long, LargestLog));
    Ratios[I] =
        std::exp(std::min(static_cast<double>(*Long) - *Short, LargestLog));
  }
  R.LargestScale = spreadOf(std::move(Values));
  R.AxisRatio = spreadOf(std::move(Ratios));
  return R;
}

} // namespace vorion::splat
