/// The host's floating-point unit while a warp runs on it: its rounding mode
/// is frm and its sticky flags are the warp's until they are taken over.
#pragma once

#include "core/SoftFloat.h"

#include <cfenv>
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace vorion::isasim {

/// frm values that the host's unit has (rne, rtz, rdn, rup).
inline constexpr uint32_t NumHostRoundings = 4;

#if defined(__x86_64__)

// MXCSR (Intel SDM volume 1, 10.2.3).
inline constexpr uint32_t MxcsrMasks = 0x1F80;
inline constexpr uint32_t MxcsrFlags = 0x3F;
inline constexpr unsigned MxcsrRoundShift = 13;

class HostFp {
public:
  /// Rounds as \p Frm (below NumHostRoundings) with no flag set, subnormals
  /// on, exceptions off.
  static void enter(uint32_t Frm) {
    constexpr uint32_t Control[NumHostRoundings] = {0, 3, 1, 2};
    _mm_setcsr(MxcsrMasks | Control[Frm] << MxcsrRoundShift);
  }
  /// The flags since enter() or the last takeFlags(), as FloatFlag bits.
  static uint32_t takeFlags() {
    const uint32_t Csr = _mm_getcsr();
    _mm_setcsr(Csr & ~MxcsrFlags);
    // Bit 1 says that an operand was subnormal, which RISC-V does not flag.
    return (Csr & 0x01 ? Invalid : 0U) | (Csr & 0x04 ? DivideByZero : 0U) |
           (Csr & 0x08 ? Overflow : 0U) | (Csr & 0x10 ? Underflow : 0U) |
           (Csr & 0x20 ? Inexact : 0U);
  }
  HostFp() : Saved(_mm_getcsr()) {}
  ~HostFp() { _mm_setcsr(Saved); }

private:
  uint32_t Saved;
#else

class HostFp {
public:
  static void enter(uint32_t Frm) {
    constexpr int Control[NumHostRoundings] = {FE_TONEAREST, FE_TOWARDZERO,
                                               FE_DOWNWARD, FE_UPWARD};
    std::fesetround(Control[Frm]);
    std::feclearexcept(FE_ALL_EXCEPT);
  }
  static uint32_t takeFlags() {
    const int Set = std::fetestexcept(FE_ALL_EXCEPT);
    std::feclearexcept(FE_ALL_EXCEPT);
    return (Set & FE_INVALID ? Invalid : 0U) |
           (Set & FE_DIVBYZERO ? DivideByZero : 0U) |
           (Set & FE_OVERFLOW ? Overflow : 0U) |
           (Set & FE_UNDERFLOW ? Underflow : 0U) |
           (Set & FE_INEXACT ? Inexact : 0U);
  }
  HostFp() { std::fegetenv(&Saved); }
  ~HostFp() { std::fesetenv(&Saved); }

private:
  std::fenv_t Saved;
#endif

public:
  HostFp(const HostFp &) = delete;
  HostFp &operator=(const HostFp &) = delete;
};

} // namespace vorion::isasim
