// Integers.

#include "translate/HostVectors.h"
#include "translate/Narrow.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

#define VORION_TWO(WIDE, NARROW)                                               \
  void HostVectors::WIDE(const Zmm &To, const Zmm &A, const Operand &B) {      \
    if (isWide())                                                              \
      return CodeGenerator::WIDE(To, A, B);                                    \
    ofTwo(To, A, B,                                                            \
          [this](const Ymm &D, const Ymm &Left, const Operand &Right) {        \
            CodeGenerator::NARROW(D, Left, Right);                             \
          });                                                                  \
  }
VORION_TWO(vpaddd, vpaddd)
VORION_TWO(vpsubd, vpsubd)
VORION_TWO(vpmulld, vpmulld)
VORION_TWO(vpmuldq, vpmuldq)
VORION_TWO(vpmuludq, vpmuludq)
VORION_TWO(vpandd, vpand)
VORION_TWO(vpandnd, vpandn)
VORION_TWO(vpord, vpor)
VORION_TWO(vpxord, vpxor)
VORION_TWO(vpshufb, vpshufb)
VORION_TWO(vpsllvd, vpsllvd)
VORION_TWO(vpsrlvd, vpsrlvd)
VORION_TWO(vpsravd, vpsravd)
#undef VORION_TWO

#define VORION_SHIFT(INSN)                                                     \
  void HostVectors::INSN(const Zmm &To, const Zmm &A, uint8_t Count) {         \
    if (isWide())                                                              \
      return CodeGenerator::INSN(To, A, Count);                                \
    ofOne(To, A, [&](const Ymm &D, const Ymm &From) {                          \
      CodeGenerator::INSN(D, From, Count);                                     \
    });                                                                        \
  }
VORION_SHIFT(vpslld)
VORION_SHIFT(vpsrld)
VORION_SHIFT(vpsrad)
VORION_SHIFT(vpsrlq)
#undef VORION_SHIFT

void HostVectors::vpslld(const Zmm &To, const Zmm &A, const Xmm &Count) {
  if (isWide())
    return CodeGenerator::vpslld(To, A, Count);
  const Xmm By(Second.getIdx());
  withHalf(Zmm(Count.getIdx()), 0, Second,
           [&](const Operand &From) { CodeGenerator::vmovdqu(Second, From); });
  ofOne(To, A, [&](const Ymm &D, const Ymm &From) {
    CodeGenerator::vpslld(D, From, By);
  });
}

void HostVectors::vprold(const Zmm &To, const Zmm &A, uint8_t Count) {
  if (isWide())
    return CodeGenerator::vprold(To, A, Count);
  ofOne(To, A, [&](const Ymm &D, const Ymm &From) {
    CodeGenerator::vpslld(Second, From, Count);
    CodeGenerator::vpsrld(D, From, static_cast<uint8_t>(WordBits - Count));
    CodeGenerator::vpor(D, D, Second);
  });
}

void HostVectors::vprolvd(const Zmm &To, const Zmm &A, const Operand &B) {
  if (isWide())
    return CodeGenerator::vprolvd(To, A, B);
  const Address CountBits = constant(WordBits - 1);
  write(To, [&](int Half, const Ymm &D) {
    const Ymm From = inYmm(A, Half, First), By = inYmm(B, Half, Second);
    CodeGenerator::vpand(MaskHalf, By, halfOf(CountBits, Half));
    CodeGenerator::vpsllvd(Second, From, MaskHalf);
    // The others of the 32 places to the right. A shift by 32 gives 0.
    CodeGenerator::vpsubd(MaskHalf, MaskHalf, halfOf(constant(WordBits), Half));
    CodeGenerator::vpsignd(MaskHalf, MaskHalf, halfOf(constant(~0U), Half));
    CodeGenerator::vpsrlvd(D, From, MaskHalf);
    CodeGenerator::vpor(D, D, Second);
  });
}

/// \p D becomes how many bits of First are set. A table says it of four bits.
void HostVectors::countBits(const Ymm &D, int Half) {
  LaneConstants OfFour{};
  for (uint32_t L = 0; L != MaxLanes; ++L)
    OfFour[L] =
        std::array{0x02010100U, 0x03020201U, 0x03020201U, 0x04030302U}[L % 4];
  const Address LowBits = halfOf(constant(0x0F0F0F0FU), Half);
  CodeGenerator::vmovdqa(MaskHalf, halfOf(vectorOf(OfFour), Half));
  CodeGenerator::vpand(Second, First, LowBits);
  CodeGenerator::vpshufb(Second, MaskHalf, Second);
  CodeGenerator::vpsrld(First, First, 4);
  CodeGenerator::vpand(First, First, LowBits);
  CodeGenerator::vpshufb(First, MaskHalf, First);
  CodeGenerator::vpaddb(First, First, Second);
  CodeGenerator::vpmaddubsw(First, First, halfOf(constant(0x01010101U), Half));
  CodeGenerator::vpmaddwd(D, First, halfOf(constant(0x00010001U), Half));
}

void HostVectors::vpopcntd(const Zmm &To, const Zmm &A) {
  if (isWide())
    return CodeGenerator::vpopcntd(To, A);
  write(To, [&](int Half, const Ymm &D) {
    CodeGenerator::vmovdqa(First, inYmm(A, Half, First));
    countBits(D, Half);
  });
}

void HostVectors::vplzcntd(const Zmm &To, const Zmm &A) {
  if (isWide())
    return CodeGenerator::vplzcntd(To, A);
  write(To, [&](int Half, const Ymm &D) {
    CodeGenerator::vmovdqa(First, inYmm(A, Half, First));
    // Ones from the highest bit on: as many zeros are left.
    for (const uint8_t By : {1, 2, 4, 8, 16}) {
      CodeGenerator::vpsrld(Second, First, By);
      CodeGenerator::vpor(First, First, Second);
    }
    CodeGenerator::vpxor(First, First, halfOf(constant(~0U), Half));
    countBits(D, Half);
  });
}

void HostVectors::markBytes(const Zmm &To, const Zmm &A) {
  if (isWide()) {
    CodeGenerator::vptestmb(k2, A, A);
    return CodeGenerator::vpmovm2b(To, k2);
  }
  write(To, [&](int Half, const Ymm &D) {
    CodeGenerator::vpxor(Second, Second, Second);
    CodeGenerator::vpcmpeqb(Second, Second, inYmm(A, Half, First));
    CodeGenerator::vpxor(D, Second, halfOf(constant(~0U), Half));
  });
}

/// By doubles (core/Level.h says why they are exact), half of the lanes at a
/// time, without a mark in the guest's flags.
void HostVectors::wideQuotient(const Zmm &To, const Zmm &A, const Zmm &B,
                               bool AreSigned, const Zmm &Divisor,
                               const Zmm &High) {
  const auto Divide = [&](const Zmm &Result, const Ymm &Over,
                          const Ymm &Under) {
    if (AreSigned) {
      CodeGenerator::vcvtdq2pd(Result, Over);
      CodeGenerator::vcvtdq2pd(Divisor, Under);
    } else {
      CodeGenerator::vcvtudq2pd(Result, Over);
      CodeGenerator::vcvtudq2pd(Divisor, Under);
    }
    CodeGenerator::vdivpd(Result, Result, Divisor | T_rn_sae);
    if (AreSigned)
      CodeGenerator::vcvtpd2dq(Ymm(Result.getIdx()), Result | T_rz_sae);
    else
      CodeGenerator::vcvttpd2udq(Ymm(Result.getIdx()), Result | T_sae);
  };
  CodeGenerator::vextracti64x4(Ymm(High.getIdx()), A, 1);
  CodeGenerator::vextracti64x4(Ymm(To.getIdx()), B, 1);
  Divide(High, Ymm(High.getIdx()), Ymm(To.getIdx()));
  Divide(To, Ymm(A.getIdx()), Ymm(B.getIdx()));
  CodeGenerator::vinserti64x4(To, To, Ymm(High.getIdx()), 1);
  // What is unsigned became all ones by itself.
  if (AreSigned) {
    CodeGenerator::vptestnmd(k2, B, B);
    CodeGenerator::vpbroadcastd(To | k2, number(~0U));
  }
}

void HostVectors::quotient(const Zmm &To, const Zmm &A, const Zmm &B,
                           bool AreSigned, const Zmm &Spare,
                           const Zmm &OtherSpare) {
  if (isWide())
    return wideQuotient(To, A, B, AreSigned, Spare, OtherSpare);
  const int Over = placeOfSpare(0), Under = placeOfSpare(1);
  const Address Status = dword[rdi + placeOfSpare(2)];
  CodeGenerator::vstmxcsr(Status);
  vmovdqa32(ptr[rdi + Over], A);
  vmovdqa32(ptr[rdi + Under], B);
  // Unsigned: less 2^31 and more 2^31, both exact.
  constexpr uint32_t TopBit = 1U << 31;
  LaneConstants Top{};
  for (uint32_t L = 1; L < MaxLanes; L += 2)
    Top[L] = 0x41E00000; // of the double 2^31
  const auto Convert = [&](const Ymm &D, int Place) {
    const Xmm Words(D.getIdx());
    CodeGenerator::vmovdqa(Words, ptr[rdi + Place]);
    if (!AreSigned)
      CodeGenerator::vpxor(Words, Words, constant(TopBit));
    CodeGenerator::vcvtdq2pd(D, Words);
    if (!AreSigned)
      CodeGenerator::vaddpd(D, D, vectorOf(Top));
  };
  constexpr int QuarterBytes = 16;
  for (int Quarter = 0; Quarter != 4; ++Quarter) {
    const int Place = Over + Quarter * QuarterBytes;
    Convert(First, Place);
    Convert(Second, Under + Quarter * QuarterBytes);
    CodeGenerator::vdivpd(First, First, Second);
    CodeGenerator::vcvttpd2dq(Xmm(First.getIdx()), First);
    CodeGenerator::vmovdqa(ptr[rdi + Place], Xmm(First.getIdx()));
  }
  CodeGenerator::vldmxcsr(Status);
  write(To, [&](int Half, const Ymm &D) {
    const Ymm Divisor = inYmm(B, Half, Second);
    CodeGenerator::vmovdqa(Out, halfAt(Over, Half));
    // A quotient of 2^31 and more that is unsigned does not fit the conversion:
    // the divisor is 1.
    if (!AreSigned) {
      CodeGenerator::vpminud(MaskHalf, Divisor, halfOf(constant(1), Half));
      CodeGenerator::vpcmpeqd(MaskHalf, MaskHalf, Divisor);
      CodeGenerator::vblendvps(Out, Out, inYmm(A, Half, First), MaskHalf);
    }
    CodeGenerator::vpxor(First, First, First);
    CodeGenerator::vpcmpeqd(First, First, Divisor);
    CodeGenerator::vpor(D, Out, First);
  });
}

} // namespace vorion::isasim::translate
