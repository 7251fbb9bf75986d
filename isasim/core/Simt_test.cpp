/// XVortex on every vector level.

#include "testing/Instructions.h"
#include "testing/WarpRunner.h"

#include <random>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

TEST(Simt, TmcTakesTheLastActiveLane) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_TMC, {.Rs1 = 10}), addi(11, 0, 1)});
    Lanes16 Masks = all(0xFFFF);
    Masks[5] = 0x0F0;
    R.setX(10, Masks);
    R.setActive(0x0023);
    R.run();
    EXPECT_EQ(R.warp().Mask, 0x00F0U);
    EXPECT_EQ(R.getX(11), bitsOf(0x00F0));
  }
}

TEST(Simt, TmcOfZeroEndsTheWarp) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {addi(11, 0, 1), encode(Op::VX_TMC, {.Rs1 = 0})});
    R.run();
    EXPECT_EQ(R.warp().Why, Stop::Ended);
    EXPECT_EQ(R.warp().Count.WarpInstructions, 2U);
  }
}

TEST(Simt, SplitRunsBothSidesAndJoinRestores) {
  for (const ExecTable *Table : allTables())
    for (const uint32_t Active : MaskPatterns)
      for (const Op O : {Op::VX_SPLIT, Op::VX_SPLIT_N}) {
        // x12 += 1 on each side, x13: lanes of the side, by its order.
        WarpRunner R(*Table,
                     {encode(O, {.Rd = 5, .Rs1 = 10}), addi(12, 12, 1),
                      encode(Op::VX_VOTE_BALLOT, {.Rd = 13, .Rs1 = 14}),
                      encode(Op::VX_JOIN, {.Rs1 = 5}), addi(15, 15, 1)});
        const uint32_t Predicate = 0x3C5A;
        R.setX(10, bitsOf(Predicate));
        R.setX(14, all(1));
        R.setActive(Active);
        R.run();
        ASSERT_TRUE(R.ranToEnd());
        EXPECT_EQ(R.warp().Mask, Active);
        EXPECT_EQ(R.warp().StackDepth, 0U);
        const uint32_t True = O == Op::VX_SPLIT ? Predicate : ~Predicate;
        const uint32_t Then = Active & True, Else = Active & ~True;
        for (unsigned L = 0; L != MaxLanes; ++L) {
          const uint32_t Bit = 1U << L;
          EXPECT_EQ(R.getX(12)[L], Active & Bit ? 1U : 0U);
          EXPECT_EQ(R.getX(15)[L], Active & Bit ? 1U : 0U);
          EXPECT_EQ(R.getX(13)[L], Bit & Then ? Then : Bit & Else ? Else : 0U);
        }
        EXPECT_EQ(R.warp().Count.DivergentSplits, Then && Else ? 1U : 0U);
        EXPECT_EQ(R.warp().Count.Splits, 1U);
      }
}

TEST(Simt, NestedSplitsGiveTheirDepth) {
  for (const ExecTable *Table : allTables()) {
    // Bits 0 and 1 of the lane number divide twice.
    WarpRunner R(*Table, {encode(Op::VX_SPLIT, {.Rd = 5, .Rs1 = 10}),
                          encode(Op::VX_SPLIT, {.Rd = 6, .Rs1 = 11}),
                          encode(Op::VX_VOTE_BALLOT, {.Rd = 13, .Rs1 = 14}),
                          encode(Op::VX_JOIN, {.Rs1 = 6}),
                          encode(Op::VX_JOIN, {.Rs1 = 5})});
    Lanes16 Halves = laneNumbers();
    for (uint32_t &L : Halves)
      L >>= 1;
    R.setX(10, laneNumbers());
    R.setX(11, Halves);
    R.setX(14, all(1));
    R.run();
    ASSERT_TRUE(R.ranToEnd());
    for (uint32_t L = 0; L != MaxLanes; ++L)
      EXPECT_EQ(R.getX(13)[L], 0x1111U << (L % 4));
    EXPECT_EQ(R.getX(5), all(0));
    EXPECT_EQ(R.getX(6), all(1));
    EXPECT_EQ(R.warp().Mask, 0xFFFFU);
  }
}

TEST(Simt, JoinWithoutASplitTraps) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_JOIN, {.Rs1 = 10})});
    R.setX(10, all(1));
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::DivergenceUnderflow);
  }
}

TEST(Simt, TooManySplitsTrap) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_SPLIT, {.Rd = 5, .Rs1 = 10}),
                          encode(Op::VX_SPLIT, {.Rd = 5, .Rs1 = 11})});
    R.warp().StackLimit = 1;
    R.setX(10, bitsOf(0x00FF));
    R.setX(11, bitsOf(0x000F));
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::DivergenceOverflow);
    EXPECT_EQ(R.warp().pcOf(R.warp().Next), VX_IMAGE_BASE + 4);
  }
}

TEST(Simt, PredNarrowsUntilNoLaneIsLeft) {
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::VX_PRED, Op::VX_PRED_N}) {
      WarpRunner R(*Table,
                   {encode(O, {.Rs1 = 10, .Rs2 = 11}), addi(12, 12, 1),
                    encode(O, {.Rs1 = 13, .Rs2 = 11}), addi(12, 12, 4)});
      const uint32_t Flip = O == Op::VX_PRED_N ? 0xFFFF : 0;
      R.setX(10, bitsOf(0x0F3C ^ Flip));
      R.setX(13, bitsOf(Flip));
      R.setX(11, all(0x7FFE)); // the mask to go back to
      R.setActive(0x7FFE);
      R.run();
      ASSERT_TRUE(R.ranToEnd());
      EXPECT_EQ(R.warp().Mask, 0x7FFEU);
      for (unsigned L = 0; L != MaxLanes; ++L)
        EXPECT_EQ(R.getX(12)[L],
                  (0x0F3C >> L & 1 ? 1U : 0U) + (0x7FFE >> L & 1 ? 4U : 0U));
    }
}

TEST(Simt, PredThatTurnsLanesOffDivides) {
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::VX_PRED, Op::VX_PRED_N}) {
      WarpRunner R(*Table, {encode(O, {.Rs1 = 10, .Rs2 = 11})});
      const uint32_t Flip = O == Op::VX_PRED_N ? 0xFFFF : 0;
      const auto Divided = [&](uint32_t Active, uint32_t Stay) {
        R.reset();
        R.setX(10, bitsOf(Stay ^ Flip));
        R.setX(11, all(0xFFFF));
        R.setActive(Active);
        R.run();
        EXPECT_EQ(R.warp().Count.Splits, 1U);
        return R.warp().Count.DivergentSplits;
      };
      EXPECT_EQ(Divided(0xFFFF, 0x00FF), 1U); // half of them leave a loop
      EXPECT_EQ(Divided(0x00FF, 0xFFFF), 0U); // all stay
      EXPECT_EQ(Divided(0x00FF, 0x0000),
                0U); // the last leave: the mask is back
      EXPECT_EQ(Divided(0x0F0F, 0x0001), 1U);
    }
}

TEST(Simt, PredThatLeavesNoLaneTraps) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_PRED, {.Rs1 = 0, .Rs2 = 0})});
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::EmptyMask);
  }
}

TEST(Simt, VotesLookAtActiveLanesOnly) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_VOTE_ALL, {.Rd = 20, .Rs1 = 10}),
                          encode(Op::VX_VOTE_ANY, {.Rd = 21, .Rs1 = 10}),
                          encode(Op::VX_VOTE_UNI, {.Rd = 22, .Rs1 = 10}),
                          encode(Op::VX_VOTE_BALLOT, {.Rd = 23, .Rs1 = 10})});
    auto Vote = [&](uint32_t Active, const Lanes16 &Values) {
      R.setX(10, Values);
      R.setActive(Active);
      R.rewind();
      R.run();
      const auto L = static_cast<unsigned>(__builtin_ctz(Active));
      return std::array<uint32_t, 4>{R.getX(20)[L], R.getX(21)[L],
                                     R.getX(22)[L], R.getX(23)[L]};
    };
    using Result = std::array<uint32_t, 4>;
    EXPECT_EQ(Vote(0xFFFF, all(2)), (Result{1, 1, 1, 0xFFFF}));
    EXPECT_EQ(Vote(0xFFFF, all(0)), (Result{0, 0, 1, 0}));
    EXPECT_EQ(Vote(0x00F0, bitsOf(0x00FF)), (Result{1, 1, 1, 0x00F0}));
    EXPECT_EQ(Vote(0x00F0, bitsOf(0xFF0F)), (Result{0, 0, 1, 0}));
    EXPECT_EQ(Vote(0x0FF0, bitsOf(0x0FC0)), (Result{0, 1, 0, 0x0FC0}));
    EXPECT_EQ(Vote(0xFFFF, laneNumbers()), (Result{0, 1, 0, 0xFFFE}));
  }
}

TEST(Simt, ShufflesFollowTheRecords) {
  std::mt19937 Random(5);
  for (const ExecTable *Table : allTables())
    for (const Op O : {Op::VX_SHFL_UP, Op::VX_SHFL_DOWN, Op::VX_SHFL_BFLY,
                       Op::VX_SHFL_IDX}) {
      WarpRunner R(*Table, {encode(O, {.Rd = 12, .Rs1 = 10, .Rs2 = 11})});
      for (int Try = 0; Try != 40; ++Try) {
        const uint32_t Active =
            MaskPatterns[Random() % std::size(MaskPatterns)];
        Lanes16 Values, Control;
        for (unsigned L = 0; L != MaxLanes; ++L) {
          Values[L] = static_cast<uint32_t>(Random());
          Control[L] = Random() % 20 |
                       (Random() % 2 ? 15 : Random() % 64) << 6 |
                       (Random() % 2 ? 0 : 0x30 + Random() % 16) << 12;
        }
        R.setX(10, Values);
        R.setX(11, Control);
        R.setX(12, all(0));
        R.setActive(Active);
        R.rewind();
        R.run();
        for (int Lane = 0; Lane != 16; ++Lane) {
          if (!(Active >> Lane & 1))
            continue;
          const int B = Control[Lane] & 63, C = Control[Lane] >> 6 & 63,
                    Segment = Control[Lane] >> 12 & 63;
          const int Lo = Lane & Segment, Hi = Lo | (C & ~Segment);
          int From = 0;
          bool Valid = false;
          switch (O) {
          case Op::VX_SHFL_UP:
            From = Lane - B;
            Valid = From >= Lo;
            break;
          case Op::VX_SHFL_DOWN:
            From = Lane + B;
            Valid = From <= Hi;
            break;
          case Op::VX_SHFL_BFLY:
            From = Lane ^ B;
            Valid = From <= Hi;
            break;
          default:
            From = Lo | (B & ~Segment);
            Valid = From <= Hi;
          }
          Valid = Valid && From < 16 && (Active >> From & 1);
          ASSERT_EQ(R.getX(12)[Lane], Values[Valid ? From : Lane])
              << InsnTable[static_cast<unsigned>(O)].Mnemonic << " lane "
              << Lane;
        }
      }
    }
}

TEST(Simt, BarrierOfOneDoesNotWait) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_BAR, {.Rs1 = 0, .Rs2 = 10})});
    R.setX(10, all(1));
    R.run();
    EXPECT_TRUE(R.ranToEnd());
    R.setX(10, all(2));
    R.rewind();
    R.run();
    EXPECT_EQ(R.warp().Why, Stop::LocalBarrier);
  }
}

TEST(Simt, BarrierThatDoesNotExistTraps) {
  WarpRunner R(execTable(false), {encode(Op::VX_BAR, {.Rs1 = 10, .Rs2 = 11})});
  R.setX(10, all(16));
  R.setX(11, all(2));
  R.run();
  EXPECT_EQ(R.cause(), TrapCause::BadBarrier);
}

TEST(Simt, BarrierThatSomeLanesDoNotReachTraps) {
  for (const ExecTable *Table : allTables()) {
    // Lanes of even number take the path with the barrier.
    WarpRunner R(*Table, {encode(Op::VX_SPLIT, {.Rd = 12, .Rs1 = 10}),
                          encode(Op::VX_BAR, {.Rs1 = 0, .Rs2 = 11})});
    Lanes16 Even{};
    for (unsigned Lane = 0; Lane != 16; ++Lane)
      Even[Lane] = Lane % 2 == 0;
    R.setX(10, Even);
    R.setX(11, all(1));
    R.run();
    EXPECT_EQ(R.cause(), TrapCause::DivergentBarrier);
  }
}

TEST(Simt, BarrierAfterAnotherThreadMaskIsReachedByAll) {
  for (const ExecTable *Table : allTables()) {
    WarpRunner R(*Table, {encode(Op::VX_TMC, {.Rs1 = 10}),
                          encode(Op::VX_BAR, {.Rs1 = 0, .Rs2 = 11})});
    R.setX(10, all(0x00FF));
    R.setX(11, all(1));
    R.run();
    EXPECT_TRUE(R.ranToEnd());
  }
}
