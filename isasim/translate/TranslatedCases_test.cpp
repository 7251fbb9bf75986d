/// Translated code where random programs (Translator_test.cpp) hardly come.

#include "core/SoftFloat.h"
#include "testing/WarpRunner.h"
#include "translate/Translator.h"

#include <cstring>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <string>
#include <utility>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

class Translated : public ::testing::TestWithParam<VectorUnit> {
protected:
  void SetUp() override {
    if (GetParam() > Translator::unitOfHost())
      GTEST_SKIP() << "the translation needs another host";
  }

  /// The translation of the program of \p R, with the guesses that \p Warp
  /// gives.
  static std::unique_ptr<Translator>
  translated(WarpRunner &R, const WarpState *Warp = nullptr) {
    auto T = std::make_unique<Translator>(R.Code, execTable(false),
                                          Translator::UsualCost, GetParam());
    T->seen(R.Code.begin(), UINT64_MAX, Warp);
    return T;
  }
};

/// \p Words behind enough others for a region.
std::vector<uint32_t> inRegion(const std::vector<uint32_t> &Words) {
  std::vector<uint32_t> All(20, encode(Op::RV_ADDI, {.Rd = 9, .Rs1 = 10}));
  All.insert(All.end(), Words.begin(), Words.end());
  return All;
}

INSTANTIATE_TEST_SUITE_P(Units, Translated,
                         ::testing::Values(VectorUnit::Avx512,
                                           VectorUnit::Avx2),
                         [](const ::testing::TestParamInfo<VectorUnit> &Of) {
                           return Of.param == VectorUnit::Avx2 ? "Avx2"
                                                               : "Avx512";
                         });

/// Global memory lies in front of the image and behind it.
TEST_P(Translated, AtomicsAddInBothPartsOfGlobalMemory) {
  std::vector<uint32_t> Words(
      20, encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 5, .Rs2 = 6}));
  Words.push_back(encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 7, .Rs2 = 6}));
  Config Large = WarpRunner::smallShape();
  Large.GlobalBytes = uint64_t{3} << 30;
  WarpRunner R(execTable(false), Words, Large);
  const auto T = translated(R);
  ASSERT_EQ(T->regions(), 1U);
  constexpr uint32_t Front = VX_GLOBAL_BASE + 64, Behind = VX_HIGH_BASE + 64;
  Lanes16 Operands, Low, High;
  for (uint32_t L = 0; L != MaxLanes; ++L) {
    Operands[L] = L;
    Low[L] = Front + L % 2 * 4;
    High[L] = Behind + 4 * L;
  }
  R.setX(5, Low);
  R.setX(6, Operands);
  R.setX(7, High);
  R.run();
  ASSERT_TRUE(R.ranToEnd());
  const auto Word = [&](uint32_t Address) {
    uint32_t W;
    std::memcpy(&W, R.global(Address), 4);
    return W;
  };
  EXPECT_EQ(Word(Front), 20U * 56);
  EXPECT_EQ(Word(Front + 4), 20U * 64);
  EXPECT_EQ(Word(Behind + 4 * 15), 15U);
  EXPECT_EQ(R.warp().Count.Atomics, 21U);
  EXPECT_EQ(R.warp().Count.Changes, 21U * 15);
  EXPECT_EQ(R.warp().Count.Parks, 0U);
}

/// Addresses are guessed from the warp's registers. A guess that turns out
/// wrong changes nothing.
TEST_P(Translated, LoadsFindOneAddressFirstWhereItIsLikely) {
  const auto Load = [](unsigned Rd, unsigned Rs) {
    return encode(Op::RV_LW, {.Rd = Rd, .Rs1 = Rs});
  };
  // x5 has one address, and that of another one; x7 has one a lane.
  WarpRunner R(execTable(false),
               inRegion({Load(6, 5), Load(11, 6), Load(8, 7), Load(12, 8)}));
  Lanes16 Table, Places;
  Table.fill(VX_GLOBAL_BASE + 64);
  for (uint32_t L = 0; L != MaxLanes; ++L) {
    Places[L] = VX_GLOBAL_BASE + 256 + 8 * L;
    const uint32_t To = VX_GLOBAL_BASE + 1024 + 4 * (15 - L);
    std::memcpy(R.global(Places[L]), &To, 4);
    std::memcpy(R.global(To), &L, 4);
  }
  std::memcpy(R.global(Table[0]), &Table[0], 4);
  R.setX(5, Table);
  R.setX(7, Places);
  const auto T = translated(R, &R.warp());
  ASSERT_EQ(T->regions(), 1U);
  EXPECT_EQ(T->guesses(), 2U);
  for (const bool IsRight : {true, false}) {
    R.setX(7, Places);
    R.setX(5, IsRight ? Table : Places);
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    for (uint32_t L = 0; L != MaxLanes; ++L) {
      EXPECT_EQ(R.getX(12)[L], L);
      EXPECT_EQ(R.getX(11)[L], IsRight ? Table[0] : L);
    }
    R.rewind();
  }
}

/// A load by the stack pointer that overwrites it looks at the address of
/// before, also where the pointer is nobody's stack.
TEST_P(Translated, LoadsOfTheStackPointerFault) {
  WarpRunner R(execTable(false),
               inRegion({encode(Op::RV_LW, {.Rd = 2, .Rs1 = 2, .Imm = 8})}));
  const auto T = translated(R);
  ASSERT_EQ(T->regions(), 1U);
  Lanes16 Nowhere;
  Nowhere.fill(0xFFFFFFF4);
  R.setX(2, Nowhere);
  R.run();
  EXPECT_EQ(R.warp().Why, Stop::Trapped);
  EXPECT_EQ(R.warp().FaultAddress, 0xFFFFFFFCU);
}

/// The same where it finds a word, but not all lanes' stack pointers name one
/// line, and vectors of the host have another address of the stacks.
TEST_P(Translated, LoadsOfTheStackPointerUseTheOldOne) {
  WarpRunner R(execTable(false),
               inRegion({encode(Op::RV_ADDI, {.Rd = 7, .Rs1 = 6}),
                         encode(Op::RV_ADDI, {.Rd = 8, .Rs1 = 7}),
                         encode(Op::RV_LW, {.Rd = 2, .Rs1 = 2, .Imm = 8})}));
  const auto T = translated(R);
  ASSERT_EQ(T->regions(), 1U);
  constexpr uint32_t Active = 0x00FF;
  const MemoryView Memory = R.Storage->view(0);
  Lanes16 Pointers, Others;
  for (uint32_t L = 0; L != MaxLanes; ++L) {
    Pointers[L] = VX_STACK_TOP - 64 - (L << Memory.StackShift);
    Others[L] = Pointers[L] - 64;
    for (const auto &[Pointer, Word] :
         {std::pair(Pointers[L], 100 + L), {Others[L], 200 + L}})
      std::memcpy(Memory.Stack.Host + Memory.stackOffset(Pointer + 8), &Word,
                  sizeof(Word));
  }
  Pointers[MaxLanes - 1] = 0;
  R.setX(2, Pointers);
  R.setX(10, Others);
  R.setActive(Active);
  R.run();
  ASSERT_TRUE(R.ranToEnd());
  for (uint32_t L = 0; L != MaxLanes; ++L)
    EXPECT_EQ(R.getX(2)[L], Active >> L & 1 ? 100 + L : Pointers[L]);
}

/// A load into x0 that is done out of line leaves alone what vectors of the
/// host have of other registers.
TEST_P(Translated, LoadsIntoX0KeepOtherRegisters) {
  WarpRunner R(execTable(false),
               inRegion({encode(Op::RV_ADDI, {.Rd = 7, .Rs1 = 6, .Imm = 1}),
                         encode(Op::RV_LW, {.Rd = 0, .Rs1 = 5}),
                         encode(Op::RV_ADD, {.Rd = 8, .Rs1 = 7, .Rs2 = 7})}));
  const auto T = translated(R);
  ASSERT_EQ(T->regions(), 1U);
  for (const uint32_t Active : {0xFFFFU, 0x0FF0U})
    for (const uint32_t Distance : {0U, 8U}) {
      Lanes16 Addresses, Values;
      for (uint32_t L = 0; L != MaxLanes; ++L) {
        Addresses[L] = VX_GLOBAL_BASE + 64 + L * Distance;
        Values[L] = 100 + L;
      }
      R.setX(5, Addresses);
      R.setX(6, Values);
      R.setX(8, {});
      R.setActive(Active);
      R.run();
      ASSERT_TRUE(R.ranToEnd());
      for (uint32_t L = 0; L != MaxLanes; ++L)
        EXPECT_EQ(R.getX(8)[L], Active >> L & 1 ? 2 * (101 + L) : 0);
      R.rewind();
    }
}

/// Conversions, divisions and such of the numbers that they change at, which
/// give the same registers and flags as the interpreter. Lanes that do not fit
/// would leave a conversion to it; so mostly a few lanes have such numbers.
TEST_P(Translated, NumbersAtBoundariesAreTheInterpreters) {
  static constexpr Op Operations[] = {
      Op::RV_FCVT_W_S, Op::RV_FCVT_WU_S, Op::RV_FCVT_S_W, Op::RV_FCVT_S_WU,
      Op::RV_FMIN_S,   Op::RV_FMAX_S,    Op::RV_FDIV_S,   Op::RV_FSQRT_S,
      Op::RV_FEQ_S,    Op::RV_FLT_S,     Op::RV_FLE_S,    Op::RV_FMADD_S,
      Op::RV_DIV,      Op::RV_DIVU,      Op::RV_REM,      Op::RV_REMU};
  static constexpr uint32_t Boundaries[] = {
      0x00000000, 0x80000000, 0x00000001, 0x80000001, 0x007FFFFF, 0x00800000,
      0x3EFFFFFF, 0x3F000000, 0x3F000001, 0xBEFFFFFF, 0xBF000000, 0xBF000001,
      0x3F800000, 0x3FC00000, 0x40200000, 0xBF7FFFFF, 0xBF800000, 0xBF800001,
      0x4B000001, 0x4EFFFFFF, 0x4F000000, 0x4F000001, 0x4F7FFFFF, 0x4F800000,
      0xCEFFFFFF, 0xCF000000, 0xCF000001, 0x7F7FFFFF, 0x7F800000, 0xFF800000,
      0x7FC00000, 0x7F800001, 0xFFFFFFFF, 0x7FFFFFFF, 0x0000FFFF, 0x01000001};
  constexpr unsigned Rounds = 1000;
  const ExecTable &Exec = execTable(false);
  std::mt19937 Random(1);
  const auto OneOf = [&Random](const auto &All) {
    return All[Random() % std::size(All)];
  };
  const auto Usual = [&Random] {
    return 0x3F800000 + static_cast<uint32_t>(Random() % 0x01000000);
  };
  for (const Op O : Operations)
    for (const unsigned Mode : {0U, 1U, 2U, 3U}) {
      const auto Words = inRegion(
          {encode(O, {.Rd = 4, .Rs1 = 5, .Rs2 = 6, .Rs3 = 4, .Rm = Mode})});
      WarpRunner Interpreted(Exec, Words), Fast(Exec, Words);
      const auto T = translated(Fast);
      ASSERT_EQ(T->regions(), 1U);
      for (unsigned Round = 0; Round != Rounds; ++Round) {
        const uint32_t Active = Round % 2 ? 0xFFFF : OneOf(MaskPatterns);
        const bool AreAll = Round % 8 == 0;
        Lanes16 Numbers[3];
        for (Lanes16 &N : Numbers) {
          for (uint32_t L = 0; L != MaxLanes; ++L)
            N[L] = AreAll || !(Active >> L & 1) ? OneOf(Boundaries) : Usual();
        }
        for (size_t Left = 1 + Random() % 4; Left != 0; --Left) {
          const size_t L = Random() % MaxLanes;
          for (Lanes16 &N : Numbers)
            N[L] = OneOf(Boundaries);
        }
        for (WarpRunner *R : {&Interpreted, &Fast}) {
          R->setActive(Active);
          for (unsigned N = 0; N != 3; ++N) {
            R->setX(4 + N, Numbers[N]);
            R->setF(4 + N, Numbers[N]);
          }
          R->run();
          ASSERT_TRUE(R->ranToEnd());
        }
        const std::string Where =
            fmt::format("operation {}, mode {}, active {:#x}, round {}",
                        static_cast<unsigned>(O), Mode, Active, Round);
        ASSERT_EQ(Interpreted.warp().Fflags, Fast.warp().Fflags) << Where;
        ASSERT_EQ(Interpreted.getX(4), Fast.getX(4)) << Where;
        ASSERT_EQ(Interpreted.getF(4), Fast.getF(4)) << Where;
        Interpreted.rewind();
        Fast.rewind();
      }
    }
}

/// The longest regions fit into the memory for one.
TEST_P(Translated, LongRegionsFit) {
  constexpr unsigned Registers = 28;
  std::vector<uint32_t> Words;
  while (Words.size() < 2400) {
    const auto R = 3 + static_cast<unsigned>(Words.size()) % Registers;
    Words.push_back(encode(Op::RV_FMADD_S,
                           {.Rd = R, .Rs1 = R + 1, .Rs2 = R - 1, .Rs3 = R}));
    Words.push_back(encode(Op::RV_LW, {.Rd = R, .Rs1 = R + 1, .Imm = 4}));
    Words.push_back(encode(Op::RV_SLT, {.Rd = R, .Rs1 = R + 1, .Rs2 = R - 1}));
  }
  WarpRunner R(execTable(false), Words);
  const auto T = translated(R);
  EXPECT_EQ(T->regions(), 1U);
  EXPECT_GT(T->bytes(), 100U << 10);
}

/// When the room for a program's code is full, the interpreter does the rest.
TEST_P(Translated, WhatHasNoRoomIsTheInterpreters) {
  constexpr size_t Room = 10 << 20, RegionWords = 2400;
  constexpr uint64_t Enough = uint64_t{1} << 40;
  std::vector<uint32_t> Words;
  while (Words.size() < 100000) {
    const auto R = 3 + static_cast<unsigned>(Words.size()) % 28;
    Words.push_back(encode(Op::RV_FMADD_S,
                           {.Rd = R, .Rs1 = R + 1, .Rs2 = R - 1, .Rs3 = R}));
    Words.push_back(encode(Op::RV_XOR, {.Rd = R, .Rs1 = R + 1, .Rs2 = R - 1}));
    Words.push_back(encode(Op::RV_FCVT_S_W, {.Rd = R, .Rs1 = R, .Rm = 0}));
    Words.push_back(encode(Op::RV_REM, {.Rd = R, .Rs1 = R, .Rs2 = R + 1}));
  }
  WarpRunner Interpreted(execTable(false), Words),
      Fast(execTable(false), Words);
  Translator T(Fast.Code, execTable(false), Translator::UsualCost, GetParam());
  const Insn *At = Fast.Code.begin();
  for (unsigned Before = ~0U; T.regions() != Before; At += RegionWords) {
    ASSERT_LT(At + RegionWords, Fast.Code.begin() + Fast.Code.count())
        << "there is room for all of the program";
    Before = T.regions();
    T.seen(At, Enough);
    ASSERT_LE(T.bytes(), Room);
  }
  EXPECT_GT(T.bytes(), Room * 3 / 4);
  for (WarpRunner *R : {&Interpreted, &Fast}) {
    for (unsigned N = 1; N != 32; ++N) {
      Lanes16 Numbers;
      for (uint32_t L = 0; L != MaxLanes; ++L)
        Numbers[L] = (N * 16 + L) * 0x9E3779B9;
      R->setX(N, Numbers);
      R->setF(N, Numbers);
    }
    R->run(1 << 20);
    ASSERT_TRUE(R->ranToEnd());
  }
  EXPECT_EQ(Interpreted.warp().Fflags, Fast.warp().Fflags);
  for (unsigned N = 0; N != 32; ++N) {
    EXPECT_EQ(Interpreted.getX(N), Fast.getX(N));
    EXPECT_EQ(Interpreted.getF(N), Fast.getF(N));
  }
}

/// Infinity times zero is invalid, whatever is added, also where the next
/// instruction overwrites a factor or computes with the result.
TEST_P(Translated, PairsFlagInfinityTimesZero) {
  const uint32_t Product =
      encode(Op::RV_FMADD_S, {.Rd = 4, .Rs1 = 1, .Rs2 = 2, .Rs3 = 3});
  const auto Sum = [](unsigned Rd, unsigned Rs) {
    return encode(Op::RV_FADD_S, {.Rd = Rd, .Rs1 = Rs, .Rs2 = 5});
  };
  const std::vector<uint32_t> Pairs[] = {
      {Product, Sum(6, 5)}, {Product, Sum(1, 5)}, {Product, Sum(2, 5)},
      {Product, Sum(6, 4)}, {Sum(6, 5), Product}, {Sum(6, 3), Product},
      {Product, Product}};
  constexpr uint32_t Infinity = 0x7F800000, Nan = 0xFFC12345, One = 0x3F800000;
  constexpr unsigned Lane = 3;
  for (const std::vector<uint32_t> &Pair : Pairs) {
    WarpRunner R(execTable(false), inRegion(Pair));
    const auto T = translated(R);
    ASSERT_EQ(T->regions(), 1U);
    for (unsigned F = 1; F != 6; ++F) {
      Lanes16 Words16;
      Words16.fill(One);
      if (F != 5)
        Words16[Lane] = F == 1 ? Infinity : F == 2 ? 0 : Nan;
      R.setF(F, Words16);
    }
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.warp().Fflags, uint32_t{Invalid});
    for (unsigned L = 0; L != MaxLanes; ++L)
      EXPECT_EQ(R.warp().Registers[FBase + 4][L],
                L == Lane ? CanonicalNan : 0x40000000U);
  }
}

} // namespace
