/// Host vectors of 16 lanes, whatever the host's vector unit is: the compiler
/// splits them where it is narrower. Included once for each vector level; the
/// only code that names a level's instructions is at the end.
#pragma once

#include "core/State.h"

#include <cstring>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define VORION_INLINE static inline __attribute__((always_inline))
#define VORION_INLINE_MEMBER inline __attribute__((always_inline))

namespace vorion::isasim::VORION_LEVEL {

using U = LaneWords;
using I32 = std::int32_t __attribute__((vector_size(4 * MaxLanes)));
using F32 = float __attribute__((vector_size(4 * MaxLanes)));
using U64 = std::uint64_t __attribute__((vector_size(8 * MaxLanes)));
using LaneBools = bool __attribute__((ext_vector_type(MaxLanes)));
template <typename T>
using Lanes __attribute__((vector_size(sizeof(T) * MaxLanes))) = T;

inline constexpr std::uint32_t AllBits = (1U << MaxLanes) - 1;

/// A bit for each lane whose comparison result is true.
VORION_INLINE std::uint32_t laneBits(I32 Condition) {
  return __builtin_bit_cast(std::uint16_t,
                            __builtin_convertvector(Condition, LaneBools));
}

VORION_INLINE U splat(std::uint32_t Value) { return U{} + Value; }
VORION_INLINE U iota() {
  return U{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
}
VORION_INLINE U asU(I32 V) { return (U)V; }
VORION_INLINE U asU(F32 V) { return (U)V; }
VORION_INLINE I32 asI(U V) { return (I32)V; }
VORION_INLINE F32 asF(U V) { return (F32)V; }

/// Then where Condition is all ones, Else where it is 0.
VORION_INLINE U select(U Condition, U Then, U Else) {
  return (Then & Condition) | (Else & ~Condition);
}
/// 1 where a comparison is true.
VORION_INLINE U one(I32 Condition) { return asU(Condition) & 1U; }

VORION_INLINE U mulHighU(U A, U B) {
  return __builtin_convertvector(
      (__builtin_convertvector(A, U64) * __builtin_convertvector(B, U64)) >> 32,
      U);
}
VORION_INLINE U mulHighSU(U A, U B) {
  return mulHighU(A, B) - (B & asU(asI(A) < 0));
}
VORION_INLINE U mulHigh(U A, U B) {
  return mulHighSU(A, B) - (A & asU(asI(B) < 0));
}

// Division lane by lane: doubles would be faster and exact, but would leave
// their flags in the host's floating-point status.
VORION_INLINE U divU(U A, U B) {
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L)
    R[L] = B[L] == 0 ? ~0U : A[L] / B[L];
  return R;
}
VORION_INLINE U remU(U A, U B) {
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L)
    R[L] = B[L] == 0 ? A[L] : A[L] % B[L];
  return R;
}
// The quotient of -2^31 and -1 wraps: negation does it without overflow.
VORION_INLINE U divS(U A, U B) {
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L) {
    const auto X = static_cast<std::int32_t>(A[L]);
    const auto Y = static_cast<std::int32_t>(B[L]);
    R[L] = Y == 0    ? ~0U
           : Y == -1 ? 0U - A[L]
                     : static_cast<std::uint32_t>(X / Y);
  }
  return R;
}
VORION_INLINE U remS(U A, U B) {
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L) {
    const auto X = static_cast<std::int32_t>(A[L]);
    const auto Y = static_cast<std::int32_t>(B[L]);
    R[L] = Y == 0 ? A[L] : Y == -1 ? 0U : static_cast<std::uint32_t>(X % Y);
  }
  return R;
}

VORION_INLINE U popCount(U A) {
  A = A - (A >> 1 & 0x55555555U);
  A = (A & 0x33333333U) + (A >> 2 & 0x33333333U);
  A = (A + (A >> 4)) & 0x0F0F0F0FU;
  return A * 0x01010101U >> 24;
}
VORION_INLINE U countTrailing(U A) { return popCount(~A & (A - 1)); }
VORION_INLINE U countLeading(U A) {
  A |= A >> 1;
  A |= A >> 2;
  A |= A >> 4;
  A |= A >> 8;
  A |= A >> 16;
  return popCount(~A);
}
VORION_INLINE U rotateLeft(U A, U B) { return A << (B & 31) | A >> (-B & 31); }
VORION_INLINE U orBytes(U A) {
  // 0xFF for each byte that is not 0: its top bit, spread downwards.
  const U Top = (((A & 0x7F7F7F7FU) + 0x7F7F7F7FU) | A) & 0x80808080U;
  return Top | (Top - (Top >> 7));
}
VORION_INLINE U swapBytes(U A) {
  return A << 24 | (A & 0xFF00U) << 8 | (A >> 8 & 0xFF00U) | A >> 24;
}

VORION_INLINE F32 fma(F32 A, F32 B, F32 C) {
  return __builtin_elementwise_fma(A, B, C);
}
VORION_INLINE F32 squareRoot(F32 A) { return __builtin_elementwise_sqrt(A); }

/// The words at byte offsets \p Offset from \p Base; lanes outside \p Mask
/// get anything.
template <bool Full>
VORION_INLINE U gather(const std::byte *Base, U Offset, std::uint32_t Mask) {
#if defined(__AVX512F__)
  const auto Index = (__m512i)Offset;
  if constexpr (Full)
    return (U)_mm512_i32gather_epi32(Index, Base, 1);
  return (U)_mm512_mask_i32gather_epi32(
      _mm512_setzero_si512(), static_cast<__mmask16>(Mask), Index, Base, 1);
#else
  U R = {};
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (Full || (Mask >> L & 1))
      std::memcpy(reinterpret_cast<std::byte *>(&R) + 4 * L, Base + Offset[L],
                  4);
  return R;
#endif
}

/// Stores words at byte offsets in lane order, so that the last lane wins.
template <bool Full>
VORION_INLINE void scatter(std::byte *Base, U Offset, U Value,
                           std::uint32_t Mask) {
#if defined(__AVX512F__)
  // Overlapping elements are written from the lowest to the highest.
  _mm512_mask_i32scatter_epi32(Base, static_cast<__mmask16>(Mask),
                               (__m512i)Offset, (__m512i)Value, 1);
#else
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (Full || (Mask >> L & 1))
      std::memcpy(Base + Offset[L],
                  reinterpret_cast<std::byte *>(&Value) + 4 * L, 4);
#endif
}

/// Stores the lanes of \p Mask at byte \p Offset + 4 * lane from \p Base. The
/// place of a lane outside the mask may be no memory at all.
VORION_INLINE void storeMasked(std::byte *Base, std::uint32_t Offset, U Value,
                               std::uint32_t Mask) {
  // Modulo 2^32 as guest addresses are: Offset may be "negative".
#if defined(__AVX512F__)
  _mm512_mask_storeu_epi32(Base + static_cast<std::int32_t>(Offset),
                           static_cast<__mmask16>(Mask), (__m512i)Value);
#else
  for (unsigned L = 0; L != MaxLanes; ++L)
    if (Mask >> L & 1)
      std::memcpy(Base + (Offset + 4 * L),
                  reinterpret_cast<std::byte *>(&Value) + 4 * L, 4);
#endif
}

/// Rounding modes of the instruction word (RISC-V F, "Rounding modes").
enum RoundingMode : unsigned { Rne = 0, Rtz = 1, Rdn = 2, Rup = 3, Rmm = 4 };

/// Whether floatToInt has host instructions.
inline constexpr bool HasFloatToInt =
#if defined(__SSE4_1__)
    true;
#else
    false;
#endif
inline constexpr bool HasFloatToUnsigned =
#if defined(__AVX512F__)
    true;
#else
    false;
#endif

#if defined(__AVX512F__)
template <bool Signed> VORION_INLINE U convertHost(F32 A) {
  return Signed ? (U)_mm512_cvtps_epi32((__m512)A)
                : (U)_mm512_cvtps_epu32((__m512)A);
}
template <bool Signed> VORION_INLINE U convertTowardZero(F32 A) {
  return Signed ? (U)_mm512_cvttps_epi32((__m512)A)
                : (U)_mm512_cvttps_epu32((__m512)A);
}
VORION_INLINE F32 roundDown(F32 A) {
  return (F32)_mm512_roundscale_ps((__m512)A, _MM_FROUND_TO_NEG_INF);
}
VORION_INLINE F32 roundUp(F32 A) {
  return (F32)_mm512_roundscale_ps((__m512)A, _MM_FROUND_TO_POS_INF);
}
#elif defined(__SSE4_1__)
// 128 bits at a time; AVX2's wider forms are what the optimiser makes of it.
#define VORION_QUARTERS(CALL)                                                  \
  U R;                                                                         \
  for (unsigned Q = 0; Q != 4; ++Q) {                                          \
    __m128 X;                                                                  \
    std::memcpy(&X, reinterpret_cast<const float *>(&A) + 4 * Q, 16);          \
    const auto Y = CALL;                                                       \
    std::memcpy(reinterpret_cast<std::uint32_t *>(&R) + 4 * Q, &Y, 16);        \
  }                                                                            \
  return
template <bool Signed> VORION_INLINE U convertHost(F32 A) {
  VORION_QUARTERS(_mm_cvtps_epi32(X)) R;
}
template <bool Signed> VORION_INLINE U convertTowardZero(F32 A) {
  VORION_QUARTERS(_mm_cvttps_epi32(X)) R;
}
VORION_INLINE F32 roundDown(F32 A) {
  VORION_QUARTERS(_mm_round_ps(X, _MM_FROUND_TO_NEG_INF)) asF(R);
}
VORION_INLINE F32 roundUp(F32 A) {
  VORION_QUARTERS(_mm_round_ps(X, _MM_FROUND_TO_POS_INF)) asF(R);
}
#undef VORION_QUARTERS
#else
        template <bool Signed>
        VORION_INLINE U convertHost(F32) {
  return U{};
}
template <bool Signed> VORION_INLINE U convertTowardZero(F32) { return U{}; }
VORION_INLINE F32 roundDown(F32 A) { return A; }
VORION_INLINE F32 roundUp(F32 A) { return A; }
#endif

} // namespace vorion::isasim::VORION_LEVEL
