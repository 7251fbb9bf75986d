/// IEEE single precision in integers, for any RISC-V rounding mode: what the
/// host's unit cannot do (round to nearest, ties away; a static mode that is
/// not the current one) and the oracle that the host's unit is tested against.
#pragma once

#include <cstdint>

namespace vorion::isasim {

/// Accrued exceptions, the bits of fflags.
enum FloatFlag : uint32_t {
  Inexact = 1,
  Underflow = 2,
  Overflow = 4,
  DivideByZero = 8,
  Invalid = 16,
};

inline constexpr uint32_t CanonicalNan = 0x7FC00000;

constexpr bool isNan(uint32_t Bits) { return (Bits & 0x7FFFFFFF) > 0x7F800000; }
constexpr bool isSignalingNan(uint32_t Bits) {
  return isNan(Bits) && !(Bits & 0x00400000);
}

// Operands and results are the bits of floats. \p Rm is 0 to 4 (rne, rtz, rdn,
// rup, rmm). Flags are added to \p Flags. Subnormals are exact, tininess is
// detected after rounding, NaN results are canonical.
uint32_t softAdd(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags);
uint32_t softMul(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags);
uint32_t softDiv(uint32_t A, uint32_t B, unsigned Rm, uint32_t &Flags);
uint32_t softSqrt(uint32_t A, unsigned Rm, uint32_t &Flags);
/// A * B + C, rounded once; infinity times zero is invalid whatever C is.
uint32_t softFma(uint32_t A, uint32_t B, uint32_t C, unsigned Rm,
                 uint32_t &Flags);
/// Out of range and NaN saturate, as fcvt.w.s and fcvt.wu.s do.
uint32_t softToInt(uint32_t A, bool Signed, unsigned Rm, uint32_t &Flags);
uint32_t softFromInt(uint32_t A, bool Signed, unsigned Rm, uint32_t &Flags);

} // namespace vorion::isasim
