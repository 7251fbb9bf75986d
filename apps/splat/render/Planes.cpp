#include "render/Planes.h"

#include "picture/Layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vorion::splat {

std::vector<float> geometryPlanes(const Scene &S) {
  const std::size_t N = S.size();
  std::vector<float> Planes(GEOMETRY_PLANES * N);
  for (std::size_t I = 0; I < N; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      Planes[(PLANE_MEAN + K) * N + I] = S.Means[3 * I + K];
      Planes[(PLANE_LOG_SCALE + K) * N + I] = S.LogScales[3 * I + K];
    }
    for (std::size_t K = 0; K < 4; ++K)
      Planes[(PLANE_QUATERNION + K) * N + I] = S.Quats[4 * I + K];
    Planes[PLANE_LOGIT * N + I] = S.OpacityLogits[I];
  }
  return Planes;
}

std::vector<float> shPlanes(const Scene &S, int Degree) {
  const std::size_t N = S.size();
  const std::size_t Planes = 3 * shCoefficients(Degree);
  const std::size_t Stride = 3 * S.coefficients();
  std::vector<float> Out(Planes * N);
  for (std::size_t I = 0; I < N; ++I)
    for (std::size_t P = 0; P < Planes; ++P)
      Out[P * N + I] = S.Sh[I * Stride + P];
  return Out;
}

namespace {

/// Blocks of \p Planes parameters: plane p of Gaussian i is Get(i, p).
template <typename Function>
std::vector<float> toBlocks(std::size_t Count, std::size_t Planes,
                            Function Get) {
  const std::size_t Blocks = (Count + LINE_WORDS - 1) / LINE_WORDS;
  std::vector<float> Words(Blocks * Planes * LINE_WORDS);
  for (std::size_t I = 0; I < Count; ++I)
    for (std::size_t P = 0; P < Planes; ++P)
      Words[(I / LINE_WORDS * Planes + P) * LINE_WORDS + I % LINE_WORDS] =
          Get(I, P);
  return Words;
}

} // namespace

std::vector<float> geometryBlocks(const Scene &S) {
  return toBlocks(S.size(), GEOMETRY_PLANES, [&](std::size_t I, std::size_t P) {
    return P < PLANE_LOG_SCALE    ? S.Means[3 * I + P - PLANE_MEAN]
           : P < PLANE_QUATERNION ? S.LogScales[3 * I + P - PLANE_LOG_SCALE]
           : P < PLANE_LOGIT      ? S.Quats[4 * I + P - PLANE_QUATERNION]
                                  : S.OpacityLogits[I];
  });
}

std::vector<float> blockBounds(const Scene &S) {
  // The radius and the deviation are rounded up, and fp32's exponential may be
  // larger.
  constexpr double Allowance = 1.00001;
  const std::size_t Blocks = (S.size() + LINE_WORDS - 1) / LINE_WORDS;
  std::vector<float> Bounds(Blocks * BOUND_PLANES);
  for (std::size_t B = 0; B < Blocks; ++B) {
    const std::size_t First = B * LINE_WORDS;
    const std::size_t Last =
        std::min<std::size_t>(First + LINE_WORDS, S.size());
    std::array<float, 3> Center{};
    double Square = 0, LogScale = S.LogScales[3 * First];
    bool IsFinite = true;
    for (std::size_t K = 0; K < 3; ++K) {
      double Least = S.Means[3 * First + K], Most = Least;
      for (std::size_t I = First; I < Last; ++I) {
        const double Mean = S.Means[3 * I + K];
        Least = std::min(Least, Mean);
        Most = std::max(Most, Mean);
        LogScale = std::max<double>(LogScale, S.LogScales[3 * I + K]);
        IsFinite &=
            std::isfinite(Mean) && std::isfinite(S.LogScales[3 * I + K]);
      }
      Center[K] = static_cast<float>((Least + Most) / 2);
    }
    for (std::size_t I = First; I < Last; ++I) {
      double Sum = 0;
      for (std::size_t K = 0; K < 3; ++K) {
        const double Along = double{S.Means[3 * I + K]} - double{Center[K]};
        Sum += Along * Along;
      }
      Square = std::max(Square, Sum);
    }
    for (std::size_t K = 0; K < 3; ++K)
      Bounds[(BOUND_CENTER + K) * Blocks + B] = Center[K];
    Bounds[BOUND_RADIUS * Blocks + B] =
        IsFinite ? static_cast<float>(std::sqrt(Square) * Allowance)
                 : std::numeric_limits<float>::infinity();
    Bounds[BOUND_DEVIATION * Blocks + B] =
        static_cast<float>(std::exp(LogScale) * Allowance);
  }
  return Bounds;
}

std::vector<float> shBlocks(const Scene &S,
                            const std::vector<std::size_t> &Planes) {
  const std::size_t Stride = 3 * S.coefficients();
  return toBlocks(S.size(), Planes.size(), [&](std::size_t I, std::size_t P) {
    return Planes[P] < Stride ? S.Sh[I * Stride + Planes[P]] : 0.0F;
  });
}

Scene sceneOfPlanes(const std::vector<float> &Geometry,
                    const std::vector<float> &Sh, int Degree) {
  const std::size_t N = Geometry.size() / GEOMETRY_PLANES;
  Scene S = Scene::sized(N, Degree);
  const std::size_t Stride = 3 * S.coefficients();
  for (std::size_t I = 0; I < N; ++I) {
    for (std::size_t K = 0; K < 3; ++K) {
      S.Means[3 * I + K] = Geometry[(PLANE_MEAN + K) * N + I];
      S.LogScales[3 * I + K] = Geometry[(PLANE_LOG_SCALE + K) * N + I];
    }
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + K] = Geometry[(PLANE_QUATERNION + K) * N + I];
    S.OpacityLogits[I] = Geometry[PLANE_LOGIT * N + I];
    for (std::size_t P = 0; P < Stride; ++P)
      S.Sh[I * Stride + P] = Sh[P * N + I];
  }
  return S;
}

} // namespace vorion::splat
