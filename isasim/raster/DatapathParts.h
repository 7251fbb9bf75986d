/// What the datapath's two directions have in common. Included once per vector
/// level, as Vector.h.
#pragma once

#include "raster/BoxWork.h"
#include "raster/ExpVector.h"
#include "raster/RasterTables.h"
#include "raster/UnitTables.h"
#include "raster/Vector.h"

#include <utility>

namespace vorion::raster {
namespace {

// docs/abi.md, Rasterizer: the largest alpha there is.
constexpr float MaxAlpha = 0.99F;
constexpr unsigned Blocks = VR_MAX_TILE / LaneCount;

/// A Gaussian's box cut to a tile: columns and rows, both ends included.
struct CutBox {
  bool Missed; ///< no pixel centre in common; nothing below is meaningful
  unsigned FirstX, LastX, FirstY, LastY;

  unsigned width() const { return LastX - FirstX + 1; }
  unsigned height() const { return LastY - FirstY + 1; }
};

/// Of the bits that are set for the centres that lie in the box.
VORION_INLINE CutBox cutBox(uint64_t InX, uint64_t InY) {
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

/// What a primitive is to 16 pixels of a row.
struct Reach {
  Int16 Counts;   ///< the pixels that it is blended into
  Float16 Wanted; ///< opacity times falloff; meaningful where it counts
};

/// By the exponent of its density. \p Open: the pixels that it may be blended
/// into. One definition for both directions: gradients go through what the
/// picture holds, and nothing else.
template <typename Exp>
VORION_INLINE Reach reach(Float16 Power, float Opacity, Int16 Open, float Bound,
                          float MinAlpha) {
  const Int16 Near = Open & (Power <= 0.0F) & ~(Power < Bound);
  if (bits(Near) == 0)
    return {Near, Power};
  const Float16 Wanted = Opacity * Exp::evaluate(Power);
  return {Near & (Wanted >= MinAlpha), Wanted};
}

VORION_INLINE BoxWork missed() { return {0, 0, true, 0, 0, 0, 0}; }

VORION_INLINE BoxWork workOf(const CutBox &Box, unsigned Fragments,
                             unsigned Blends) {
  return {Fragments,
          Blends,
          false,
          static_cast<uint8_t>(Box.FirstX),
          static_cast<uint8_t>(Box.FirstY),
          static_cast<uint8_t>(Box.width()),
          static_cast<uint8_t>(Box.height())};
}

/// The bodies of a kind's units, by row of the tables.
template <typename... Units> struct List {};
template <template <uint32_t> class Body, uint32_t... Numbers>
List<Body<Numbers>...> listOf(std::integer_sequence<uint32_t, Numbers...>);
template <template <uint32_t> class Body, uint32_t Count>
using Bodies =
    decltype(listOf<Body>(std::make_integer_sequence<uint32_t, Count>()));
using Exps = Bodies<ExpRow, ExpRowCount>;

[[maybe_unused]] bool hostHasLevel() {
#if defined(__AVX512F__)
  return __builtin_cpu_supports("avx512f") &&
         __builtin_cpu_supports("avx512bw") &&
         __builtin_cpu_supports("avx512dq") &&
         __builtin_cpu_supports("avx512vl");
#elif defined(__AVX2__)
  return __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") &&
         __builtin_cpu_supports("bmi") && __builtin_cpu_supports("popcnt");
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
