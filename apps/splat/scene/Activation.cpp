#include "scene/Activation.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vorion::splat {

template <typename Real> Activated<Real> activate(const Scene &S) {
  Activated<Real> A;
  A.Scales.reserve(S.LogScales.size());
  for (const float L : S.LogScales)
    A.Scales.push_back(static_cast<Real>(std::exp(double(L))));
  A.Quats.resize(S.Quats.size());
  for (std::size_t I = 0; I + 3 < S.Quats.size(); I += 4) {
    double Squares = 0;
    for (int K = 0; K < 4; ++K)
      Squares += double(S.Quats[I + K]) * S.Quats[I + K];
    const double Norm = std::sqrt(Squares);
    for (int K = 0; K < 4; ++K)
      A.Quats[I + K] =
          Norm > 0 ? static_cast<Real>(S.Quats[I + K] / Norm) : Real(0);
  }
  A.Opacities.reserve(S.OpacityLogits.size());
  for (const float L : S.OpacityLogits)
    A.Opacities.push_back(static_cast<Real>(1 / (1 + std::exp(-double(L)))));
  return A;
}

float opacityLogit(double Opacity) {
  constexpr double Limit = 30;
  const double Logit = std::log(Opacity) - std::log1p(-Opacity);
  return static_cast<float>(std::clamp(Logit, -Limit, Limit));
}

void resolveInfinities(Scene &S) {
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  const float Absent = opacityLogit(0), Opaque = opacityLogit(1);
  for (float &Logit : S.OpacityLogits)
    if (std::isinf(Logit))
      Logit = Logit > 0 ? Opaque : Absent;
  std::ranges::replace(S.LogScales, -Infinity, FlatLogScale);
}

void flatten(Scene &S) {
  for (std::size_t I = 0; I < S.size(); ++I) {
    float *Own = &S.LogScales[3 * I];
    std::size_t Least = 2;
    for (const std::size_t K : {1, 0})
      if (Own[K] < Own[Least])
        Least = K;
    Own[Least] = FlatLogScale;
  }
}

template Activated<float> activate<float>(const Scene &);
template Activated<double> activate<double>(const Scene &);

} // namespace vorion::splat
