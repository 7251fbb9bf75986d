/// Atomics of a warp: the order of lanes, what each kind leaves, pairs of
/// words, and which of them wait for the other cores.

#include "core/MemoryTest.h"

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Memory, AtomicsRunInLaneOrder) {
  struct Case {
    Op O;
    uint32_t Start;
    Lanes16 Operands;
    uint32_t Result;
  };
  const Lanes16 Same = {5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5, 5};
  const Lanes16 Steps = {1, 2, 4, 8, 16, 32, 64, 128, 1, 1, 1, 1, 1, 1, 1, 1};
  const Lanes16 Mixed = {7,          ~0U, 3, 9, 1, 2, 8, 4,
                         0x80000000, 6,   5, 7, 7, 7, 7, 7};
  for (const ExecTable *Table : allTables())
    for (const Case &C : {Case{Op::RV_AMOADD_W, 100, Same, 180},
                          Case{Op::RV_AMOSWAP_W, 1, Mixed, 7},
                          Case{Op::RV_AMOXOR_W, 0, Steps, 255},
                          Case{Op::RV_AMOOR_W, 0, Steps, 255},
                          Case{Op::RV_AMOAND_W, 0xFF, Same, 5},
                          Case{Op::RV_AMOMIN_W, 3, Mixed, 0x80000000},
                          Case{Op::RV_AMOMAX_W, 3, Mixed, 9},
                          Case{Op::RV_AMOMINU_W, 3, Mixed, 1},
                          Case{Op::RV_AMOMAXU_W, 3, Mixed, ~0U}}) {
      WarpRunner R(*Table, {encode(C.O, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
      constexpr uint32_t Place = VX_LOCAL_BASE + 64; // local memory: at once
      std::memcpy(R.warp().Mem->Local.at(Place), &C.Start, 4);
      runOn(R, 0xFFFF, all(Place), C.Operands);
      ASSERT_TRUE(R.ranToEnd());
      EXPECT_EQ(wordOf(R.warp().Mem->Local.at(Place)), C.Result)
          << InsnTable[static_cast<unsigned>(C.O)].Mnemonic;
      EXPECT_EQ(R.getX(12)[0], C.Start);
      if (C.O == Op::RV_AMOADD_W)
        for (uint32_t L = 0; L != MaxLanes; ++L)
          EXPECT_EQ(R.getX(12)[L], 100 + 5 * L);
      if (C.O == Op::RV_AMOSWAP_W)
        for (uint32_t L = 1; L != MaxLanes; ++L)
          EXPECT_EQ(R.getX(12)[L], Mixed[L - 1]);
    }
}

TEST(Memory, CompareAndSwapComparesWithRd) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_W, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
    Lanes16 Values, Expected;
    for (uint32_t L = 0; L != MaxLanes; ++L) {
      Values[L] = L + 1;
      Expected[L] = L == 4 ? 77 : L; // lane 4 breaks the chain
    }
    R.setX(12, Expected);
    runOn(R, 0xFFFF, all(VX_LOCAL_BASE), Values);
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(wordOf(R.warp().Mem->Local.at(VX_LOCAL_BASE)), 4U);
    EXPECT_EQ(R.getX(12),
              (Lanes16{0, 1, 2, 3, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4, 4}));
  }
}

TEST(Memory, CompareAndSwapWithX0ComparesWithZero) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})});
    runOn(R, 0x0006, all(VX_LOCAL_BASE), all(3));
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(wordOf(R.warp().Mem->Local.at(VX_LOCAL_BASE)), 3U);
    EXPECT_EQ(R.getX(0), Lanes16{});
  }
}

TEST(Memory, CompareAndSwapOfPairsComparesBothWords) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_D, {.Rd = 12, .Rs1 = 10, .Rs2 = 14})});
    Lanes16 Low{}, High{}, NewHigh;
    for (uint32_t L = 0; L != MaxLanes; ++L)
      NewHigh[L] = L + 1;
    High = {0, 1, 7, 2, 3}; // lane 2 is wrong in the high word,
    Low[3] = 5;             // lane 3 in the low one
    R.setX(10, all(VX_LOCAL_BASE + 8));
    R.setX(12, Low);
    R.setX(13, High);
    R.setX(14, Lanes16{});
    R.setX(15, NewHigh);
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    uint32_t Got[4] = {};
    std::memcpy(Got, R.warp().Mem->Local.at(VX_LOCAL_BASE), sizeof(Got));
    EXPECT_EQ(std::to_array(Got), (std::array{0U, 0U, 0U, 2U}));
    EXPECT_EQ(R.getX(12), Lanes16{});
    EXPECT_EQ(R.getX(13),
              (Lanes16{0, 1, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2, 2}));
  }
}

TEST(Memory, AtomicsOfPairsReachEachLanesStack) {
  // The two words of a lane are not neighbours on the host.
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table,
                 {encode(Op::RV_AMOCAS_D, {.Rd = 0, .Rs1 = 10, .Rs2 = 14}),
                  encode(Op::RV_LW, {.Rd = 6, .Rs1 = 10}),
                  encode(Op::RV_LW, {.Rd = 7, .Rs1 = 10, .Imm = 4})});
    Lanes16 Places = stackTops(R.Shape), Low, High;
    for (uint32_t L = 0; L != MaxLanes; ++L) {
      Places[L] -= 16;
      Low[L] = L + 1;
      High[L] = 100 + L;
    }
    R.setX(10, Places);
    R.setX(14, Low);
    R.setX(15, High);
    R.run();
    ASSERT_EQ(R.warp().Why, Stop::Atomic);
    ASSERT_TRUE(R.completeAtomic());
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    EXPECT_EQ(R.getX(6), Low);
    EXPECT_EQ(R.getX(7), High);
  }
}

TEST(Memory, AtomicsOfPairsWantEightBytes) {
  for (const ExecTable *Table : allTables())
    for (const uint32_t Address : {VX_LOCAL_BASE + 4, Buffer + 12}) {
      WarpRunner R(*Table,
                   {encode(Op::RV_AMOCAS_D, {.Rd = 0, .Rs1 = 10, .Rs2 = 14})});
      R.setX(10, all(Address));
      R.run();
      ASSERT_EQ(R.warp().Why, Stop::Atomic);
      EXPECT_FALSE(R.completeAtomic());
      EXPECT_EQ(R.cause(), TrapCause::MisalignedStore);
      EXPECT_EQ(R.warp().FaultAddress, Address);
    }
}

TEST(Memory, AtomicsOnGlobalMemoryPark) {
  const ExecTable &Table = execTable(false);
  WarpRunner Used(Table,
                  {encode(Op::RV_AMOADD_W, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
  runOn(Used, 0xFFFF, all(Buffer), all(1));
  EXPECT_EQ(Used.warp().Why, Stop::Atomic);
  // An addition without a result need not wait.
  WarpRunner Unused(Table,
                    {encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})});
  runOn(Unused, 0xFFFF, all(Buffer), all(1));
  EXPECT_TRUE(Unused.ranToEnd());
  EXPECT_EQ(wordOf(Unused.global(Buffer)), 16U);
}

TEST(Memory, AdditionsBehindTheImageDoNotPark) {
  WarpRunner R(execTable(false),
               {encode(Op::RV_AMOADD_W, {.Rd = 0, .Rs1 = 10, .Rs2 = 11})},
               shapeWithHighMemory());
  runOn(R, 0xFFFF, all(VX_HIGH_BASE + 4), all(1));
  EXPECT_TRUE(R.ranToEnd());
  EXPECT_EQ(wordOf(R.global(VX_HIGH_BASE + 4)), 16U);
}
