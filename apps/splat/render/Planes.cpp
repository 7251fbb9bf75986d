#include "render/Planes.h"

#include "picture/Layout.h"
#include "vorion/support/Parallel.h"

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

std::size_t blockWords(std::size_t Count, std::size_t Planes) {
  return std::size_t{blocksOf(Count)} * Planes * LINE_WORDS;
}

namespace {

/// Writes blocks of \p Planes parameters: plane p of Gaussian i is Get(i, p).
/// Read(i, j) is called when the Gaussians from i to j - 1 are written.
template <typename Function, typename Notice>
void writeBlocks(std::size_t Count, std::size_t Planes, std::span<float> To,
                 Function Get, Notice Read) {
  // Blocks of a thread at a time: half a megabyte or more.
  constexpr std::size_t Part = 1 << 12;
  inParallelParts(blocksOf(Count), Part,
                  [&](std::size_t First, std::size_t End) {
                    float *Word = &To[First * Planes * LINE_WORDS];
                    for (std::size_t Block = First; Block < End; ++Block)
                      for (std::size_t P = 0; P < Planes; ++P)
                        for (std::size_t I = Block * LINE_WORDS;
                             I < (Block + 1) * LINE_WORDS; ++I)
                          *Word++ = I < Count ? Get(I, P) : 0;
                    Read(First * LINE_WORDS,
                         std::min<std::size_t>(End * LINE_WORDS, Count));
                  });
}

} // namespace

void writeGeometryBlocks(const Scene &S, std::span<float> To) {
  writeBlocks(
      S.size(), GEOMETRY_PLANES, To,
      [&](std::size_t I, std::size_t P) {
        return P < PLANE_LOG_SCALE    ? S.Means[3 * I + P - PLANE_MEAN]
               : P < PLANE_QUATERNION ? S.LogScales[3 * I + P - PLANE_LOG_SCALE]
               : P < PLANE_LOGIT      ? S.Quats[4 * I + P - PLANE_QUATERNION]
                                      : S.OpacityLogits[I];
      },
      [](std::size_t, std::size_t) {});
}

void writeShBlocks(const Scene &S, const std::vector<std::size_t> &Planes,
                   std::span<float> To,
                   const std::function<void(std::size_t, std::size_t)> &Read) {
  const std::size_t Stride = 3 * S.coefficients();
  writeBlocks(
      S.Sh.size() / Stride, Planes.size(), To,
      [&](std::size_t I, std::size_t P) {
        return Planes[P] < Stride ? S.Sh[I * Stride + Planes[P]] : 0.0F;
      },
      [&](std::size_t First, std::size_t End) {
        if (Read)
          Read(First, End);
      });
}

/// Of the Gaussians from \p First to \p Last, by layout.h's BOUND_PLANES.
static std::array<float, BOUND_PLANES>
boundsOf(const Scene &S, std::size_t First, std::size_t Last) {
  // The radius and the deviation are rounded up, and fp32's exponential may be
  // larger.
  constexpr double Allowance = 1.00001;
  std::array<float, BOUND_PLANES> B{};
  double LogScale = S.LogScales[3 * First];
  bool IsFinite = true;
  for (std::size_t K = 0; K < 3; ++K) {
    double Least = S.Means[3 * First + K], Most = Least;
    for (std::size_t I = First; I < Last; ++I) {
      const double Mean = S.Means[3 * I + K], Scale = S.LogScales[3 * I + K];
      Least = std::min(Least, Mean);
      Most = std::max(Most, Mean);
      LogScale = std::max(LogScale, Scale);
      IsFinite &= std::isfinite(Mean) && std::isfinite(Scale);
    }
    B[BOUND_CENTER + K] = static_cast<float>((Least + Most) / 2);
  }
  double Radius = 0;
  for (std::size_t I = First; I < Last; ++I)
    Radius = std::max(
        Radius, std::hypot(S.Means[3 * I] - double{B[BOUND_CENTER]},
                           S.Means[3 * I + 1] - double{B[BOUND_CENTER + 1]},
                           S.Means[3 * I + 2] - double{B[BOUND_CENTER + 2]}));
  B[BOUND_RADIUS] = IsFinite ? static_cast<float>(Radius * Allowance)
                             : std::numeric_limits<float>::infinity();
  B[BOUND_DEVIATION] = static_cast<float>(std::exp(LogScale) * Allowance);
  return B;
}

std::vector<float> blockBounds(const Scene &S) {
  const std::size_t Blocks = blocksOf(S.size());
  std::vector<float> Bounds(Blocks * BOUND_PLANES);
  for (std::size_t Block = 0; Block < Blocks; ++Block) {
    const std::size_t First = Block * LINE_WORDS;
    const auto Own =
        boundsOf(S, First, std::min<std::size_t>(First + LINE_WORDS, S.size()));
    for (std::size_t P = 0; P < BOUND_PLANES; ++P)
      Bounds[P * Blocks + Block] = Own[P];
  }
  return Bounds;
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
