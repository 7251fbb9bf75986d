/// Translated code where random programs (Translator_test.cpp) hardly come.

#include "core/SoftFloat.h"
#include "testing/WarpRunner.h"
#include "translate/Translator.h"

#include <cstring>
#include <gtest/gtest.h>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

class Translated : public ::testing::TestWithParam<VectorUnit> {
protected:
  void SetUp() override {
    if (GetParam() > Translator::unitOfHost())
      GTEST_SKIP() << "the translation needs another host";
  }
};

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
  const ExecTable &Exec = execTable(false);
  WarpRunner R(Exec, Words, Large);
  Translator T(R.Code, Exec, Translator::UsualCost, GetParam());
  T.seen(R.Code.begin(), UINT64_MAX);
  ASSERT_EQ(T.regions(), 1U);
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
  std::vector<uint32_t> Words(20, encode(Op::RV_ADDI, {.Rd = 9, .Rs1 = 10}));
  // x5 has one address, and that of another one; x7 has one a lane.
  Words.insert(Words.end(), {Load(6, 5), Load(11, 6), Load(8, 7), Load(12, 8)});
  const ExecTable &Exec = execTable(false);
  WarpRunner R(Exec, Words);
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
  Translator T(R.Code, Exec, Translator::UsualCost, GetParam());
  T.seen(R.Code.begin(), UINT64_MAX, &R.warp());
  ASSERT_EQ(T.regions(), 1U);
  EXPECT_EQ(T.guesses(), 2U);
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
  std::vector<uint32_t> Words(20, encode(Op::RV_ADDI, {.Rd = 9, .Rs1 = 10}));
  Words.push_back(encode(Op::RV_LW, {.Rd = 2, .Rs1 = 2, .Imm = 8}));
  const ExecTable &Exec = execTable(false);
  WarpRunner R(Exec, Words);
  Translator T(R.Code, Exec, Translator::UsualCost, GetParam());
  T.seen(R.Code.begin(), UINT64_MAX);
  ASSERT_EQ(T.regions(), 1U);
  Lanes16 Nowhere;
  Nowhere.fill(0xFFFFFFF4);
  R.setX(2, Nowhere);
  R.run();
  EXPECT_EQ(R.warp().Why, Stop::Trapped);
  EXPECT_EQ(R.warp().FaultAddress, 0xFFFFFFFCU);
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
  const ExecTable &Exec = execTable(false);
  WarpRunner R(Exec, Words);
  Translator T(R.Code, Exec, Translator::UsualCost, GetParam());
  T.seen(R.Code.begin(), UINT64_MAX);
  EXPECT_EQ(T.regions(), 1U);
  EXPECT_GT(T.bytes(), 100U << 10);
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
    std::vector<uint32_t> Words(20, encode(Op::RV_ADDI, {.Rd = 7, .Rs1 = 8}));
    Words.insert(Words.end(), Pair.begin(), Pair.end());
    const ExecTable &Exec = execTable(false);
    WarpRunner R(Exec, Words);
    Translator T(R.Code, Exec, Translator::UsualCost, GetParam());
    T.seen(R.Code.begin(), UINT64_MAX);
    ASSERT_EQ(T.regions(), 1U);
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
