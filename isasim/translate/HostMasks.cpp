// Masks: comparisons, and what depends on them.

#include "translate/HostVectors.h"
#include "translate/Narrow.h"

namespace vorion::isasim::translate {

using namespace Xbyak;
using namespace Xbyak::util;

namespace {

/// AVX2 compares for equality, and what has signs for greater. So each relation
/// is an equality or the opposite of one: of both operands, or of the first one
/// and the greater or the lesser of both.
bool isOpposite(Relation Of) {
  return Of == Relation::NotEqual || Of == Relation::Less ||
         Of == Relation::Greater;
}

} // namespace

/// Half of the equality that \p Of is made of.
void HostVectors::compareHalf(const Ymm &D, int Half, const Zmm &A,
                              const Operand &B, Relation Of, bool AreSigned) {
  const Ymm Left = inYmm(A, Half, First);
  withHalf(B, Half, Second, [&](const Operand &Right) {
    switch (Of) {
    case Relation::Equal:
    case Relation::NotEqual:
      return CodeGenerator::vpcmpeqd(D, Left, Right);
    case Relation::Less:
    case Relation::NotLess:
      AreSigned ? CodeGenerator::vpmaxsd(Second, Left, Right)
                : CodeGenerator::vpmaxud(Second, Left, Right);
      break;
    case Relation::LessEqual:
    case Relation::Greater:
      AreSigned ? CodeGenerator::vpminsd(Second, Left, Right)
                : CodeGenerator::vpminud(Second, Left, Right);
      break;
    }
    CodeGenerator::vpcmpeqd(D, Second, Left);
  });
}

void HostVectors::compare(const Opmask &To, const Zmm &A, const Operand &B,
                          Relation Of, bool AreSigned) {
  write(To, isOpposite(Of), [&](int Half, const Ymm &D) {
    compareHalf(D, Half, A, B, Of, AreSigned);
  });
}

/// The active lanes whose sign is set by \p Compute(half, register), or, if
/// \p IsInverted, is not. Overwrites ecx.
template <typename F>
void HostVectors::signs(const Reg32 &To, bool IsInverted, bool AreAllActive,
                        F Compute) {
  constexpr uint8_t LanesOfHalf = 8;
  Compute(0, Out);
  CodeGenerator::vmovmskps(To, Out);
  Compute(1, Out);
  CodeGenerator::vmovmskps(ecx, Out);
  shl(ecx, LanesOfHalf);
  or_(To, ecx);
  if (IsInverted)
    xor_(To, AllBits);
  if (!AreAllActive)
    and_(To, dword[rdi + VORION_PLACE(Mask)]);
}

void HostVectors::lanesWhere(const Reg32 &To, const Zmm &A, const Operand &B,
                             Relation Of, bool AreSigned, bool AreAllActive) {
  signs(To, isOpposite(Of), AreAllActive, [&](int Half, const Ymm &D) {
    compareHalf(D, Half, A, B, Of, AreSigned);
  });
}

void HostVectors::oddLanes(const Reg32 &To, const Zmm &A, bool AreEven,
                           bool AreAllActive) {
  if (isWide()) {
    const Opmask K = AreAllActive ? k2 : k2 | k1;
    AreEven ? CodeGenerator::vptestnmd(K, A, constant(1))
            : CodeGenerator::vptestmd(K, A, constant(1));
    return CodeGenerator::kmovw(To, k2);
  }
  signs(To, AreEven, AreAllActive, [&](int Half, const Ymm &D) {
    CodeGenerator::vpslld(D, inYmm(A, Half, First), WordBits - 1);
  });
}

void HostVectors::vpcmpd(const Opmask &To, const Zmm &A, const Operand &B,
                         Relation Of) {
  isWide() ? CodeGenerator::vpcmpd(To, A, B, static_cast<uint8_t>(Of))
           : compare(To, A, B, Of, true);
}
void HostVectors::vpcmpud(const Opmask &To, const Zmm &A, const Operand &B,
                          Relation Of) {
  isWide() ? CodeGenerator::vpcmpud(To, A, B, static_cast<uint8_t>(Of))
           : compare(To, A, B, Of, false);
}
void HostVectors::vpcmpeqd(const Opmask &To, const Zmm &A, const Operand &B) {
  isWide() ? CodeGenerator::vpcmpeqd(To, A, B)
           : compare(To, A, B, Relation::Equal, false);
}

void HostVectors::testBits(const Opmask &To, const Zmm &A, const Operand &B,
                           bool AreZero) {
  CodeGenerator::vpxor(Second, Second, Second);
  write(To, !AreZero, [&](int Half, const Ymm &D) {
    const Ymm Left = inYmm(A, Half, First);
    withHalf(B, Half, MaskHalf, [&](const Operand &Right) {
      if (!Right.isMEM() && Right.getIdx() == Left.getIdx())
        return CodeGenerator::vpcmpeqd(D, Left, Second);
      CodeGenerator::vpand(MaskHalf, Left, Right);
      CodeGenerator::vpcmpeqd(D, MaskHalf, Second);
    });
  });
}

void HostVectors::vptestmd(const Opmask &To, const Zmm &A, const Operand &B) {
  isWide() ? CodeGenerator::vptestmd(To, A, B) : testBits(To, A, B, false);
}
void HostVectors::vptestnmd(const Opmask &To, const Zmm &A, const Operand &B) {
  isWide() ? CodeGenerator::vptestnmd(To, A, B) : testBits(To, A, B, true);
}

void HostVectors::vpmovd2m(const Opmask &To, const Zmm &From) {
  if (isWide())
    return CodeGenerator::vpmovd2m(To, From);
  constexpr uint8_t SignBit = 31;
  write(To, false, [&](int Half, const Ymm &D) {
    CodeGenerator::vpsrad(D, inYmm(From, Half, First), SignBit);
  });
}

void HostVectors::vpmovm2d(const Zmm &To, const Opmask &From) {
  if (isWide())
    return CodeGenerator::vpmovm2d(To, From);
  write(To, [&](int Half, const Ymm &D) {
    withMask(From.getIdx(), Half,
             [&](const Operand &M) { CodeGenerator::vmovdqu(D, M); });
  });
}

void HostVectors::kmovw(const Reg32 &To, const Opmask &From) {
  if (isWide())
    return CodeGenerator::kmovw(To, From);
  if (From.getIdx() == ActiveMask)
    return mov(To, dword[rdi + VORION_PLACE(Mask)]);
  withMask(From.getIdx(), 0,
           [&](const Operand &M) { CodeGenerator::vmovdqu(First, M); });
  withMask(From.getIdx(), 1, [&](const Operand &M) {
    CodeGenerator::vpackssdw(First, First, M);
  });
  CodeGenerator::vpermq(First, First, QuartersInOrder);
  CodeGenerator::vextracti128(Xmm(Second.getIdx()), First, 1);
  CodeGenerator::vpacksswb(Xmm(First.getIdx()), Xmm(First.getIdx()),
                           Xmm(Second.getIdx()));
  CodeGenerator::vpmovmskb(To, Xmm(First.getIdx()));
}

void HostVectors::kmovw(const Opmask &To, const Reg32 &From) {
  if (isWide())
    return CodeGenerator::kmovw(To, From);
  LaneConstants Bits{};
  for (uint32_t L = 0; L != MaxLanes; ++L)
    Bits[L] = 1U << L;
  const Address OfLanes = vectorOf(Bits);
  CodeGenerator::vmovd(Xmm(Second.getIdx()), From);
  CodeGenerator::vpbroadcastd(Second, Xmm(Second.getIdx()));
  write(To, false, [&](int Half, const Ymm &D) {
    CodeGenerator::vmovdqa(First, halfOf(OfLanes, Half));
    CodeGenerator::vpand(Out, Second, First);
    CodeGenerator::vpcmpeqd(D, Out, First);
  });
}

void HostVectors::setAll(const Opmask &To) {
  if (isWide())
    return CodeGenerator::kxnorw(To, To, To);
  write(To, false,
        [&](int, const Ymm &D) { CodeGenerator::vpcmpeqd(D, D, D); });
}

void HostVectors::copy(const Opmask &To, const Opmask &From) {
  if (isWide())
    return CodeGenerator::kmovw(To, From);
  write(To, false, [&](int Half, const Ymm &D) {
    withMask(From.getIdx(), Half,
             [&](const Operand &M) { CodeGenerator::vmovdqu(D, M); });
  });
}

void HostVectors::kortestw(const Opmask &A, const Opmask &B) {
  if (isWide())
    return CodeGenerator::kortestw(A, B);
  withMask(A.getIdx(), 0,
           [&](const Operand &M) { CodeGenerator::vmovdqu(First, M); });
  const auto Or = [&](const Operand &M) {
    CodeGenerator::vpor(First, First, M);
  };
  withMask(A.getIdx(), 1, Or);
  if (B.getIdx() != A.getIdx())
    for (const int Half : {0, 1})
      withMask(B.getIdx(), Half, Or);
  CodeGenerator::vptest(First, First);
}

void HostVectors::jumpIfDiffer(const Zmm &A, const Zmm &B, bool AreAllActive,
                               Label &To) {
  if (isWide()) {
    CodeGenerator::vpcmpud(AreAllActive ? k2 : k2 | k1, A, B,
                           static_cast<uint8_t>(Relation::NotEqual));
    CodeGenerator::kortestw(k2, k2);
    return jnz(To);
  }
  for (const int Half : {0, 1}) {
    const Ymm D = Half == 0 ? Out : First;
    withHalf(B, Half, Second, [&](const Operand &Right) {
      CodeGenerator::vpxor(D, inYmm(A, Half, MaskHalf), Right);
    });
    if (!AreAllActive)
      CodeGenerator::vpand(D, D, halfAt(placeOfMask(ActiveMask), Half));
  }
  CodeGenerator::vpor(Out, Out, First);
  CodeGenerator::vptest(Out, Out);
  jnz(To);
}

void HostVectors::jumpIfNan(const Zmm &A, const Zmm &B, bool AreAllActive,
                            Label &To) {
  if (isWide()) {
    CodeGenerator::vcmpps(AreAllActive ? k2 : k2 | k1, A, B, Unordered);
    CodeGenerator::kortestw(k2, k2);
    return jnz(To);
  }
  // A comparison is unordered where either operand is a NaN. So one comparison,
  // of one half with the other, looks at both.
  const auto Compare = [&](const Ymm &D, const Zmm &Of) {
    Ymm Halves[2] = {First, Second};
    for (const int Half : {0, 1})
      if (AreAllActive)
        Halves[Half] = inYmm(Of, Half, Halves[Half]);
      else
        CodeGenerator::vpand(Halves[Half], inYmm(Of, Half, Halves[Half]),
                             halfAt(placeOfMask(ActiveMask), Half));
    CodeGenerator::vcmpps(D, Halves[0], Halves[1], Unordered);
  };
  Compare(Out, A);
  if (A.getIdx() != B.getIdx()) {
    Compare(MaskHalf, B);
    CodeGenerator::vpor(Out, Out, MaskHalf);
  }
  CodeGenerator::vptest(Out, Out);
  jnz(To);
}

} // namespace vorion::isasim::translate
