// Floats: what rounds, and conversions.

#include "core/RoundingMode.h"
#include "translate/HostVectors.h"
#include "translate/Narrow.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

/// Half of \p A, in \p To, with \p Idle in lanes that are not active. Out has
/// the active ones.
void HostVectors::activeHalf(const Ymm &To, const Operand &A, int Half,
                             uint32_t Idle) {
  if (Idle == 0)
    return withHalf(A, Half, To, [&](const Operand &From) {
      CodeGenerator::vpand(To, Out, From);
    });
  CodeGenerator::vmovdqa(To, halfOf(constant(Idle), Half));
  withHalf(A, Half, To, [&](const Operand &From) {
    CodeGenerator::vblendvps(To, To, From, Out);
  });
}

/// Out becomes half of the active lanes.
void HostVectors::loadActive(int Half) {
  CodeGenerator::vmovdqa(Out, halfAt(placeOfMask(ActiveMask), Half));
}

/// As ofTwo(), where lanes that are not active compute with 0 and \p Idle.
template <typename F>
void HostVectors::rounded(const Zmm &To, const Zmm &A, const Zmm &B,
                          uint32_t Idle, F Insn) {
  if (To.getOpmaskIdx() == 0)
    return ofTwo(To, A, B, Insn);
  write(To, [&](int Half, const Ymm &D) {
    loadActive(Half);
    activeHalf(First, A, Half, 0);
    activeHalf(Second, B, Half, Idle);
    Insn(D, First, Second);
  });
}

#define VORION_ROUNDED(INSN, IDLE)                                             \
  void HostVectors::INSN(const Zmm &To, const Zmm &A, const Zmm &B) {          \
    if (isWide())                                                              \
      return CodeGenerator::INSN(To, A, B);                                    \
    rounded(To, A, B, IDLE,                                                    \
            [this](const Ymm &D, const Ymm &Left, const Operand &Right) {      \
              CodeGenerator::INSN(D, Left, Right);                             \
            });                                                                \
  }
VORION_ROUNDED(vaddps, 0)
VORION_ROUNDED(vsubps, 0)
VORION_ROUNDED(vmulps, 0)
VORION_ROUNDED(vdivps, OneBits)
#undef VORION_ROUNDED

void HostVectors::vsqrtps(const Zmm &To, const Zmm &A) {
  if (isWide())
    return CodeGenerator::vsqrtps(To, A);
  write(To, [&](int Half, const Ymm &D) {
    CodeGenerator::vsqrtps(D, inputHalf(To, A, Half, First));
  });
}

/// Half of \p A for what becomes \p To. If \p To has the mask of the active
/// lanes, the others have 0, and Out is overwritten.
Ymm HostVectors::inputHalf(const Operand &To, const Zmm &A, int Half,
                           const Ymm &Spare) {
  if (To.getOpmaskIdx() == 0)
    return inYmm(A, Half, Spare);
  loadActive(Half);
  activeHalf(Spare, A, Half, 0);
  return Spare;
}

template <typename F>
void HostVectors::ofThree(const Zmm &To, const Zmm &A, const Zmm &B, F Insn) {
  write(To, [&](int Half, const Ymm &D) {
    if (To.getOpmaskIdx() != 0) {
      loadActive(Half);
      activeHalf(First, A, Half, 0);
      activeHalf(Second, B, Half, 0);
      activeHalf(Out, Zmm(To.getIdx()), Half, 0); // the addend
      return Insn(D, First, Second);
    }
    loadOld(To, Half, D);
    const Ymm Left = inYmm(A, Half, First);
    withHalf(B, Half, Second,
             [&](const Operand &Right) { Insn(D, Left, Right); });
  });
}

#define VORION_FUSED(INSN)                                                     \
  void HostVectors::INSN(const Zmm &To, const Zmm &A, const Zmm &B) {          \
    if (isWide())                                                              \
      return CodeGenerator::INSN(To, A, B);                                    \
    ofThree(To, A, B,                                                          \
            [this](const Ymm &D, const Ymm &Left, const Operand &Right) {      \
              CodeGenerator::INSN(D, Left, Right);                             \
            });                                                                \
  }
VORION_FUSED(vfmadd231ps)
VORION_FUSED(vfmsub231ps)
VORION_FUSED(vfnmadd231ps)
VORION_FUSED(vfnmsub231ps)
#undef VORION_FUSED

void HostVectors::vcmpps(const Opmask &To, const Zmm &A, const Zmm &B,
                         uint8_t Of) {
  if (isWide())
    return CodeGenerator::vcmpps(To, A, B, Of);
  write(To, false, [&](int Half, const Ymm &D) {
    const Ymm Left = inputHalf(To, A, Half, First);
    const Ymm Right = inputHalf(To, B, Half, Second);
    CodeGenerator::vcmpps(D, Left, Right, Of);
  });
}

/// Of two zeros the host gives the second one, so both orders have the signs of
/// both.
void HostVectors::leastOrGreatest(const Zmm &To, const Zmm &A, const Zmm &B,
                                  bool IsLeast) {
  write(To, [&](int Half, const Ymm &D) {
    const Ymm Left = inputHalf(To, A, Half, First);
    const Ymm Right = inputHalf(To, B, Half, Second);
    if (IsLeast) {
      CodeGenerator::vminps(MaskHalf, Left, Right);
      CodeGenerator::vminps(D, Right, Left);
      return CodeGenerator::vpor(D, D, MaskHalf);
    }
    CodeGenerator::vmaxps(MaskHalf, Left, Right);
    CodeGenerator::vmaxps(D, Right, Left);
    CodeGenerator::vpand(D, D, MaskHalf);
  });
}

void HostVectors::least(const Zmm &To, const Zmm &A, const Zmm &B) {
  constexpr uint8_t Lesser = 4; // vrangeps: with its own sign
  isWide() ? CodeGenerator::vrangeps(To, A, B, Lesser)
           : leastOrGreatest(To, A, B, true);
}
void HostVectors::greatest(const Zmm &To, const Zmm &A, const Zmm &B) {
  constexpr uint8_t Greater = 5;
  isWide() ? CodeGenerator::vrangeps(To, A, B, Greater)
           : leastOrGreatest(To, A, B, false);
}

//===----------------------------------------------------------------------===//
// Conversions
//===----------------------------------------------------------------------===//

namespace {

constexpr bool isDirected(uint32_t Mode) { return Mode == Rdn || Mode == Rup; }

constexpr uint32_t TwoTo31 = 0x4F000000, TwoTo32 = 0x4F800000;

} // namespace

/// A direction in the host's instruction keeps it from raising flags. What fits
/// is inexact in every mode, or in none.
void HostVectors::wideToInt(const Zmm &To, const Zmm &A, uint32_t Mode,
                            bool IsSigned, const Zmm &Spare, Label &Wrong) {
  const auto Round = [&](const Zmm &From) {
    IsSigned ? CodeGenerator::vcvtps2dq(To, From)
             : CodeGenerator::vcvtps2udq(To, From);
  };
  const auto Truncate = [&](const Zmm &Into) {
    IsSigned ? CodeGenerator::vcvttps2dq(Into, A)
             : CodeGenerator::vcvttps2udq(Into, A);
  };
  if (isDirected(Mode))
    Round(Mode == Rdn ? A | T_rd_sae : A | T_ru_sae);
  else if (Mode == Rtz)
    Truncate(To);
  else
    Round(A);
  jumpIfAnyIs(To, IsSigned ? 1U << 31 : ~0U, Wrong);
  if (isDirected(Mode))
    Truncate(To.getOpmaskIdx() ? Spare | k1 : Spare);
}

void HostVectors::jumpIfAnyIs(const Zmm &A, uint32_t Bits, Label &To) {
  vpcmpeqd(A.getOpmaskIdx() ? k2 | k1 : k2, Zmm(A.getIdx()), constant(Bits));
  kortestw(k2, k2);
  jnz(To);
}

/// \p D becomes the signed integer of First.
void HostVectors::narrowToInt(const Ymm &D, uint32_t Mode) {
  if (!isDirected(Mode))
    return Mode == Rtz ? CodeGenerator::vcvttps2dq(D, First)
                       : CodeGenerator::vcvtps2dq(D, First);
  // This one says what is inexact.
  constexpr uint8_t Down = 1, Up = 2;
  CodeGenerator::vroundps(D, First, Mode == Rdn ? Down : Up);
  CodeGenerator::vcvttps2dq(D, D);
}

void HostVectors::toInt(const Zmm &To, const Zmm &A, uint32_t Mode,
                        bool IsSigned, const Zmm &Spare, Label &Wrong) {
  if (isWide())
    return wideToInt(To, A, Mode, IsSigned, Spare, Wrong);
  const Zmm All(To.getIdx());
  if (IsSigned) {
    write(All, [&](int Half, const Ymm &D) {
      const Ymm From = inputHalf(To, A, Half, First);
      if (From.getIdx() != First.getIdx())
        CodeGenerator::vmovaps(First, From);
      narrowToInt(D, Mode);
    });
    return jumpIfAnyIs(To, 1U << 31, Wrong);
  }
  // The first three hold for NaNs, which do not fit either.
  constexpr uint8_t NotGreaterEqual = 0x19, NotGreater = 0x1A, NotLess = 0x15,
                    GreaterEqual = 0x1D;
  constexpr uint32_t MinusOne = 0xBF800000, MinusHalf = 0xBF000000;
  const uint32_t Least = Mode == Rdn                  ? 0
                         : Mode == Rtz || Mode == Rup ? MinusOne
                                                      : MinusHalf;
  const uint8_t Below =
      Mode == Rtz || Mode == Rup ? NotGreater : NotGreaterEqual;
  write(k2, false, [&](int Half, const Ymm &D) {
    const Ymm From = inputHalf(To, A, Half, First);
    CodeGenerator::vcmpps(Second, From, halfOf(constant(Least), Half), Below);
    CodeGenerator::vcmpps(D, From, halfOf(constant(TwoTo32), Half), NotLess);
    CodeGenerator::vpor(D, D, Second);
  });
  kortestw(k2, k2);
  jnz(Wrong);
  // From 2^31 on less 2^31, which is exact; that bit is set afterwards.
  write(All, [&](int Half, const Ymm &D) {
    const Ymm From = inputHalf(To, A, Half, First);
    const Address Top = halfOf(constant(TwoTo31), Half);
    CodeGenerator::vcmpps(Second, From, Top, GreaterEqual);
    CodeGenerator::vandps(MaskHalf, Second, Top);
    CodeGenerator::vsubps(First, From, MaskHalf);
    narrowToInt(D, Mode);
    CodeGenerator::vpslld(Second, Second, WordBits - 1);
    CodeGenerator::vpxor(D, D, Second);
  });
}

void HostVectors::fromInt(const Zmm &To, const Zmm &A, uint32_t Mode,
                          bool IsSigned, const Zmm &Spare) {
  if (isWide()) {
    const auto Convert = [&](const Zmm &Into, const Zmm &From) {
      IsSigned ? CodeGenerator::vcvtdq2ps(Into, From)
               : CodeGenerator::vcvtudq2ps(Into, From);
    };
    // A direction raises nothing. What is no float is inexact in every mode.
    if (Mode == Rtz || isDirected(Mode))
      Convert(To.getOpmaskIdx() ? Spare | k1 : Spare, A);
    return Convert(To, Mode == Rtz   ? A | T_rz_sae
                       : Mode == Rdn ? A | T_rd_sae
                       : Mode == Rup ? A | T_ru_sae
                                     : A);
  }
  if (IsSigned)
    return write(To, [&](int Half, const Ymm &D) {
      CodeGenerator::vcvtdq2ps(D, inputHalf(To, A, Half, First));
    });
  // Both halves of a word as floats without error: 2^23 and the lower one, 2^39
  // and 2^16 times the upper one. Their sum less both powers rounds once.
  constexpr uint32_t TwoTo23 = 0x4B000000, TwoTo39 = 0x53000000,
                     Both = 0x53000080;
  constexpr uint8_t UpperHalves = 0xAA;
  write(To, [&](int Half, const Ymm &D) {
    const Ymm From = inputHalf(To, A, Half, First);
    CodeGenerator::vpblendw(Second, From, halfOf(constant(TwoTo23), Half),
                            UpperHalves);
    CodeGenerator::vpsrld(First, From, WordBits / 2);
    CodeGenerator::vpblendw(First, First, halfOf(constant(TwoTo39), Half),
                            UpperHalves);
    CodeGenerator::vsubps(First, First, halfOf(constant(Both), Half));
    CodeGenerator::vaddps(D, Second, First);
  });
}

} // namespace vorion::isasim::translate
