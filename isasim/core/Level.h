/// Host vectors of 16 lanes, whatever the host's vector unit is: the compiler
/// splits them where it is narrower. Included once for each vector level; the
/// only code that names a level's instructions is at the end.
#pragma once

#include "core/RoundingMode.h"
#include "core/State.h"

#include <cstring>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

#define VORION_INLINE static inline __attribute__((always_inline))
#define VORION_INLINE_MEMBER inline __attribute__((always_inline))

namespace vorion::isasim::VORION_LEVEL {

using U = LaneWords;
using I32 = int32_t __attribute__((vector_size(4 * MaxLanes)));
using F32 = float __attribute__((vector_size(4 * MaxLanes)));
using U64 = uint64_t __attribute__((vector_size(8 * MaxLanes)));
using LaneBools = bool __attribute__((ext_vector_type(MaxLanes)));
template <typename T>
using Lanes __attribute__((vector_size(sizeof(T) * MaxLanes))) = T;

inline constexpr uint32_t AllBits = (1U << MaxLanes) - 1;

/// A bit for each lane whose comparison result is true.
VORION_INLINE uint32_t laneBits(I32 Condition) {
  return __builtin_bit_cast(uint16_t,
                            __builtin_convertvector(Condition, LaneBools));
}

VORION_INLINE U splat(uint32_t Value) { return U{} + Value; }
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

#if defined(__AVX2__)
/// Half of a register, as the host's instructions take it.
VORION_INLINE __m256i half(const U &V, unsigned Which) {
  __m256i R;
  std::memcpy(&R, reinterpret_cast<const std::byte *>(&V) + 32 * Which, 32);
  return R;
}
VORION_INLINE U join(__m256i Low, __m256i High) {
  U R;
  std::memcpy(&R, &Low, 32);
  std::memcpy(reinterpret_cast<std::byte *>(&R) + 32, &High, 32);
  return R;
}
VORION_INLINE __m128i quarter(const U &V, unsigned Which) {
  __m128i R;
  std::memcpy(&R, reinterpret_cast<const std::byte *>(&V) + 16 * Which, 16);
  return R;
}
#endif

/// The value of lane Index % 16.
VORION_INLINE U permute(U Value, U Index) {
#if defined(__AVX2__)
  const U FromLow =
      join(_mm256_permutevar8x32_epi32(half(Value, 0), half(Index, 0)),
           _mm256_permutevar8x32_epi32(half(Value, 0), half(Index, 1)));
  const U FromHigh =
      join(_mm256_permutevar8x32_epi32(half(Value, 1), half(Index, 0)),
           _mm256_permutevar8x32_epi32(half(Value, 1), half(Index, 1)));
  return select(asU((Index & 8U) != splat(0)), FromHigh, FromLow);
#else
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L)
    R[L] = Value[Index[L] % MaxLanes];
  return R;
#endif
}

#if defined(__AVX2__)
// Division by doubles is exact in any rounding mode: a quotient of 32-bit
// integers that is no integer is further from the next one than doubles can be
// wrong. The flags that it leaves are not the guest's.
VORION_INLINE __m256d toDouble(__m128i V, bool Signed) {
  // Unsigned: less 2^31 and more 2^31, both exact.
  const __m128i Top = _mm_set1_epi32(Signed ? 0 : INT32_MIN);
  return _mm256_add_pd(_mm256_cvtepi32_pd(_mm_xor_si128(V, Top)),
                       _mm256_set1_pd(Signed ? 0 : 0x1p31));
}
VORION_INLINE U quotient(U A, U B, bool Signed) {
  const unsigned Status = _mm_getcsr();
  __m128i Parts[4];
  for (unsigned Q = 0; Q != 4; ++Q)
    Parts[Q] = _mm256_cvttpd_epi32(_mm256_div_pd(
        toDouble(quarter(A, Q), Signed), toDouble(quarter(B, Q), Signed)));
  U R;
  std::memcpy(&R, Parts, sizeof(R));
  // Nothing of it may be done after the old flags are back.
  __asm__ volatile("" : "+m"(R));
  _mm_setcsr(Status);
  return R;
}
// A quotient of 2^31 and more that is unsigned does not fit the conversion: the
// divisor is 1. What is signed and does not fit becomes -2^31, as it should.
VORION_INLINE U divU(U A, U B) {
  const U Large = asU(B <= splat(1));
  return select(Large, A, quotient(A, B, false)) | asU(B == splat(0));
}
VORION_INLINE U divS(U A, U B) {
  return quotient(A, B, true) | asU(B == splat(0));
}
VORION_INLINE U remU(U A, U B) { return A - divU(A, B) * B; }
VORION_INLINE U remS(U A, U B) { return A - divS(A, B) * B; }
#else
// Lane by lane.
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
    const auto X = static_cast<int32_t>(A[L]);
    const auto Y = static_cast<int32_t>(B[L]);
    R[L] = Y == 0 ? ~0U : Y == -1 ? 0U - A[L] : static_cast<uint32_t>(X / Y);
  }
  return R;
}
VORION_INLINE U remS(U A, U B) {
  U R;
  for (unsigned L = 0; L != MaxLanes; ++L) {
    const auto X = static_cast<int32_t>(A[L]);
    const auto Y = static_cast<int32_t>(B[L]);
    R[L] = Y == 0 ? A[L] : Y == -1 ? 0U : static_cast<uint32_t>(X % Y);
  }
  return R;
}
#endif

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
/// By the last five bits of B.
VORION_INLINE U shiftLeft(U A, U B) {
#if defined(__x86_64__) && !defined(__AVX2__)
  // This host has no shift by a vector. Compilers multiply by powers of two
  // that they convert from floats, and the last one does not fit: the host
  // would say "invalid", and the guest's flags with it.
  const U Some = A << (B & 15);
  return select(asU((B & 16U) != splat(0)), Some << 16, Some);
#else
  return A << (B & 31);
#endif
}
/// The one that the last five bits of B number.
VORION_INLINE U bit(U B) { return shiftLeft(splat(1), B); }
VORION_INLINE U rotateLeft(U A, U B) {
  return shiftLeft(A, B) | A >> (-B & 31);
}
VORION_INLINE U orBytes(U A) {
  // 0xFF for each byte that is not 0: its top bit, spread downwards.
  const U Top = (((A & 0x7F7F7F7FU) + 0x7F7F7F7FU) | A) & 0x80808080U;
  return Top | (Top - (Top >> 7));
}
VORION_INLINE U swapBytes(U A) {
  return A << 24 | (A & 0xFF00U) << 8 | (A >> 8 & 0xFF00U) | A >> 24;
}

/// fclass.s.
VORION_INLINE U classify(U A) {
  const U Exponent = A >> 23 & 0xFFU, Fraction = A & 0x7FFFFFU;
  const U Negative = asU(asI(A) < 0);
  const U Nan =
      select(asU(Fraction < 0x400000U), splat(1U << 8), splat(1U << 9));
  const U Infinite = select(Negative, splat(1U << 0), splat(1U << 7));
  const U Normal = select(Negative, splat(1U << 1), splat(1U << 6));
  const U Subnormal = select(Negative, splat(1U << 2), splat(1U << 5));
  const U Zero = select(Negative, splat(1U << 3), splat(1U << 4));
  const U NoFraction = asU(Fraction == 0U);
  return select(
      asU(Exponent == 0xFFU), select(NoFraction, Infinite, Nan),
      select(asU(Exponent == 0U), select(NoFraction, Zero, Subnormal), Normal));
}

VORION_INLINE F32 fma(F32 A, F32 B, F32 C) {
  return __builtin_elementwise_fma(A, B, C);
}
VORION_INLINE F32 squareRoot(F32 A) { return __builtin_elementwise_sqrt(A); }

/// The words at byte offsets \p Offset from \p Base.
VORION_INLINE U gather(const std::byte *Base, U Offset) {
#if defined(__AVX2__)
  const auto *Words = reinterpret_cast<const int *>(Base);
  return join(_mm256_i32gather_epi32(Words, half(Offset, 0), 1),
              _mm256_i32gather_epi32(Words, half(Offset, 1), 1));
#else
  U R = {};
  for (unsigned L = 0; L != MaxLanes; ++L)
    std::memcpy(reinterpret_cast<std::byte *>(&R) + 4 * L, Base + Offset[L], 4);
  return R;
#endif
}

// Conversion to signed integers: what does not fit becomes -2^31.
#if defined(__SSE4_1__)
inline constexpr bool HasFloatToInt = true;
// 128 bits at a time; wider forms are what the optimiser makes of it.
#define VORION_QUARTERS(CALL)                                                  \
  U R;                                                                         \
  for (unsigned Q = 0; Q != 4; ++Q) {                                          \
    __m128 X;                                                                  \
    std::memcpy(&X, reinterpret_cast<const float *>(&A) + 4 * Q, 16);          \
    const auto Y = CALL;                                                       \
    std::memcpy(reinterpret_cast<uint32_t *>(&R) + 4 * Q, &Y, 16);             \
  }                                                                            \
  return
VORION_INLINE U convertHost(F32 A) { VORION_QUARTERS(_mm_cvtps_epi32(X)) R; }
VORION_INLINE U convertTowardZero(F32 A) {
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
inline constexpr bool HasFloatToInt = false;
VORION_INLINE U convertHost(F32) { return U{}; }
VORION_INLINE U convertTowardZero(F32) { return U{}; }
VORION_INLINE F32 roundDown(F32 A) { return A; }
VORION_INLINE F32 roundUp(F32 A) { return A; }
#endif

} // namespace vorion::isasim::VORION_LEVEL
