/// What the datapath's two directions have in common. Included once per vector
/// level, as Vector.h.
#pragma once

#include "raster/ExpVector.h"
#include "raster/RasterTables.h"
#include "raster/Vector.h"

namespace vorion::raster {
namespace {

// docs/abi.md, Rasterizer: the largest alpha there is.
constexpr float MaxAlpha = 0.99F;
constexpr unsigned Blocks = VR_MAX_TILE / LaneCount;

/// Bit i is set if centre i lies in the box, found by the definition itself, so
/// that no coordinate is ever converted to an integer. Always one run of bits.
VORION_INLINE std::uint64_t inBox(const float *Centres, float Mean,
                                  float Extent) {
  std::uint64_t Result = 0;
  for (unsigned B = 0; B != Blocks; ++B) {
    const Float16 Distance =
        __builtin_elementwise_abs(load(Centres + B * LaneCount) - Mean);
    Result |= std::uint64_t{bits(Distance <= Extent)} << (B * LaneCount);
  }
  return Result;
}

/// A Gaussian's box cut to a tile: columns and rows, both ends included.
struct CutBox {
  bool Missed; ///< no pixel centre in common; nothing below is meaningful
  unsigned FirstX, LastX, FirstY, LastY;

  unsigned width() const { return LastX - FirstX + 1; }
  unsigned height() const { return LastY - FirstY + 1; }
};

VORION_INLINE CutBox cutBox(const Gaussian &G, const float *CentreX,
                            const float *CentreY) {
  const std::uint64_t InX = inBox(CentreX, G.Mean[0], G.Extent[0]);
  const std::uint64_t InY = inBox(CentreY, G.Mean[1], G.Extent[1]);
  if (InX == 0 || InY == 0)
    return {true, 0, 0, 0, 0};
  return {false, static_cast<unsigned>(__builtin_ctzll(InX)),
          63 - static_cast<unsigned>(__builtin_clzll(InX)),
          static_cast<unsigned>(__builtin_ctzll(InY)),
          63 - static_cast<unsigned>(__builtin_clzll(InY))};
}

/// Below this power alpha is surely under \p MinAlpha, by a margin beyond the
/// unit's error: saves the exponential in a box's corners, changes no result.
/// NaN or negative opacity: no bound needed, alpha is never MinAlpha.
VORION_INLINE float powerBound(float Opacity, float MinAlpha, float Margin) {
  return __builtin_logf(MinAlpha / Opacity) - Margin;
}

/// Units in the order of their options.
template <typename... Units> struct List {};
using Exps =
    List<CorrectlyRoundedExp, TableExp<4>, PolynomialExp<2>, PolynomialExp<3>,
         PolynomialExp<4>, TableExp<5>, TableExp<6>, LinearExp, SchraudolphExp>;

[[maybe_unused]] bool hostHasLevel() {
#if defined(__AVX512F__)
  return __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
         __builtin_cpu_supports("popcnt");
#else
  return true;
#endif
}

} // namespace

#define VORION_STRING_OF(Name) #Name
#define VORION_STRING(Name) VORION_STRING_OF(Name)
#define VORION_JOIN_OF(A, B) A##B
#define VORION_JOIN(A, B) VORION_JOIN_OF(A, B)

} // namespace vorion::raster
