/// 16 lanes as host vectors (clang's vector extension). Included only by the
/// file that is compiled once per vector level: everything has internal linkage
/// and is inlined, so that no level's code can stand in for another's.
#pragma once

#include <cstdint>

namespace vorion::raster {
namespace {

/// Lanes of the rasterizer (paper, "Gaussian rasterizer architecture").
constexpr unsigned LaneCount = 16;

// NOLINTBEGIN(modernize-use-using): the attribute is part of the declarator
typedef float Float16 __attribute__((ext_vector_type(16)));
typedef int32_t Int16 __attribute__((ext_vector_type(16)));
typedef double Double8 __attribute__((ext_vector_type(8)));
typedef float Float8 __attribute__((ext_vector_type(8)));
typedef int64_t Long8 __attribute__((ext_vector_type(8)));
typedef bool Bool16 __attribute__((ext_vector_type(16)));
// NOLINTEND(modernize-use-using)

#define VORION_INLINE [[gnu::always_inline]] inline

/// Bit per lane of a comparison's result.
VORION_INLINE uint32_t bits(Int16 Mask) {
  return __builtin_bit_cast(uint16_t, __builtin_convertvector(Mask, Bool16));
}

/// Without a call, whatever the level.
VORION_INLINE unsigned countBits(uint32_t Bits) {
  return static_cast<unsigned>(__builtin_popcount(Bits));
}

VORION_INLINE Float16 load(const float *From) {
  Float16 V;
  __builtin_memcpy(&V, From, sizeof(V));
  return V;
}

VORION_INLINE void store(float *To, Float16 V) {
  __builtin_memcpy(To, &V, sizeof(V));
}

VORION_INLINE Int16 load(const uint32_t *From) {
  Int16 V;
  __builtin_memcpy(&V, From, sizeof(V));
  return V;
}

VORION_INLINE void store(uint32_t *To, Int16 V) {
  __builtin_memcpy(To, &V, sizeof(V));
}

} // namespace
} // namespace vorion::raster
