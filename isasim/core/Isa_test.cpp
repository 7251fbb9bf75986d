#include "core/Isa.h"

#include "testing/Encode.h"

#include <gtest/gtest.h>
#include <random>

using namespace vorion::isasim;
using vorion::isasim::testing::encode;

TEST(Isa, NoTwoEncodingsOverlap) {
  for (unsigned A = 0; A != NumOps; ++A)
    for (unsigned B = A + 1; B != NumOps; ++B) {
      const InsnInfo &X = InsnTable[A], &Y = InsnTable[B];
      EXPECT_NE((X.Match ^ Y.Match) & X.Mask & Y.Mask, 0U)
          << X.Mnemonic << " and " << Y.Mnemonic;
    }
}

TEST(Isa, MatchLiesWithinMask) {
  for (const InsnInfo &I : InsnTable)
    EXPECT_EQ(I.Match & ~I.Mask, 0U) << I.Mnemonic;
}

TEST(Isa, CsrTableAscends) {
  for (unsigned N = 1; N < NumCsrs; ++N)
    EXPECT_LT(CsrTable[N - 1].Number, CsrTable[N].Number);
  for (const CsrInfo &C : CsrTable)
    EXPECT_EQ(findCsrInfo(C.Number), &C);
  EXPECT_EQ(findCsrInfo(0x7FF), nullptr);
}

TEST(Isa, ReadOnlyNumbersAreReadOnly) {
  // The top two bits of a CSR's number say so (Zicsr, "CSR field").
  for (const CsrInfo &C : CsrTable)
    if (C.Number >> 10 == 3)
      EXPECT_EQ(C.Rule, WriteRule::None) << C.Name;
}

TEST(Isa, EncodeThenDecodeGivesTheFieldsBack) {
  std::mt19937 Random(1);
  for (unsigned N = 0; N != NumOps; ++N) {
    const auto O = static_cast<Op>(N);
    const InsnInfo &Info = InsnTable[N];
    for (int Try = 0; Try != 50; ++Try) {
      vorion::isasim::testing::Fields F;
      F.Rd = Random() % 32;
      F.Rs1 = Random() % 32;
      F.Rs2 = Random() % 32;
      F.Rs3 = Random() % 32;
      F.Rm = Random() % 5;
      F.Csr = Random() % 4096;
      switch (Info.Fmt) {
      case Format::B:
        F.Imm = (static_cast<int32_t>(Random()) >> 20) * 2;
        break;
      case Format::J:
        F.Imm = (static_cast<int32_t>(Random()) >> 12) * 2;
        break;
      case Format::U:
        F.Imm = static_cast<int32_t>(Random() >> 12);
        break;
      case Format::IShift:
      case Format::ICsrImm:
        F.Imm = static_cast<int32_t>(Random() % 32);
        break;
      default:
        F.Imm = static_cast<int32_t>(Random()) >> 20;
      }
      if (Info.Pairs) {
        F.Rd &= ~1U;
        F.Rs2 &= ~1U;
      }
      const auto D = decode(encode(O, F));
      ASSERT_TRUE(D) << Info.Mnemonic;
      EXPECT_EQ(D->Opcode, O) << Info.Mnemonic;
      if (Info.Rd != File::None)
        EXPECT_EQ(D->Rd, F.Rd) << Info.Mnemonic;
      if (Info.Rs1 != File::None)
        EXPECT_EQ(D->Rs1, F.Rs1) << Info.Mnemonic;
      if (Info.Rs2 != File::None)
        EXPECT_EQ(D->Rs2, F.Rs2) << Info.Mnemonic;
      if (Info.Rs3 != File::None)
        EXPECT_EQ(D->Rs3, F.Rs3) << Info.Mnemonic;
      if (Info.HasRm)
        EXPECT_EQ(D->Rm, F.Rm) << Info.Mnemonic;
      const int32_t Imm =
          Info.Fmt == Format::U
              ? static_cast<int32_t>(static_cast<uint32_t>(F.Imm) << 12)
              : F.Imm;
      const bool HasImm = Info.Fmt != Format::R && Info.Fmt != Format::R4 &&
                          Info.Fmt != Format::Plain && Info.Fmt != Format::ICsr;
      if (HasImm)
        EXPECT_EQ(D->Imm, Imm) << Info.Mnemonic;
    }
  }
}

TEST(Isa, ReservedRoundingModesDoNotDecode) {
  for (const unsigned Rm : {5U, 6U})
    EXPECT_FALSE(decode(encode(Op::RV_FADD_S, {.Rd = 1, .Rm = Rm})));
  EXPECT_TRUE(decode(encode(Op::RV_FADD_S, {.Rd = 1, .Rm = 4})));
}

TEST(Isa, PairsOfOddRegistersDoNotDecode) {
  const uint32_t Word =
      encode(Op::RV_AMOCAS_D, {.Rd = 10, .Rs1 = 11, .Rs2 = 12});
  EXPECT_EQ(disassemble(Word, 0), "amocas.d\ta0, a2, (a1)");
  EXPECT_FALSE(decode(Word | 1U << 7));
  EXPECT_FALSE(decode(Word | 1U << 20));
  EXPECT_TRUE(decode(Word | 1U << 15)); // the address is one register
}

TEST(Isa, LoadReservedDoesNotDecode) {
  EXPECT_FALSE(decode(0x1005A52F)); // lr.w a0, (a1)
  EXPECT_FALSE(decode(0x18C5A52F)); // sc.w a0, a2, (a1)
  EXPECT_FALSE(decode(0x00000000));
  EXPECT_FALSE(decode(0xFFFFFFFF));
}

TEST(Isa, DisassemblesWithNames) {
  // vx_split with a third register is neither vx_split nor vx_split_n.
  EXPECT_EQ(disassemble(0x0022A50B, 0), ".word 0x0022a50b");
  EXPECT_EQ(disassemble(encode(Op::VX_SPLIT, {.Rd = 10, .Rs1 = 11}), 0),
            "vx_split\ta0, a1");
  EXPECT_EQ(
      disassemble(
          encode(Op::RV_CSRRW, {.Rd = 0, .Rs1 = 10, .Csr = CSR_VR_START}), 0),
      "csrrw\tzero, vr_start, a0");
  EXPECT_EQ(disassemble(encode(Op::RV_BNE, {.Rs1 = 5, .Rs2 = 6, .Imm = -8}),
                        0x80000010),
            "bne\tt0, t1, 0x80000008");
  EXPECT_EQ(
      disassemble(encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 2, .Rs2 = 3, .Rm = 1}),
                  0),
      "fadd.s\tft1, ft2, ft3, rtz");
}
