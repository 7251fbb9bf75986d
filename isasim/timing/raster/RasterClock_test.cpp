/// The rasterizer's time against closed formulas.
#include "testing/Boxes.h"
#include "timing/common/DatapathUnits.h"
#include "timing/raster/RasterClock.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace vorion::isasim;
using vorion::raster::CommandWork;
using vorion::raster::GaussianWork;

namespace {

/// Pushed Gaussians into a tile that its core drains: no memory at all.
CommandWork pushed(std::vector<GaussianWork> Gaussians) {
  CommandWork W;
  W.What.Width = W.What.Height = 64;
  W.What.Drains = true;
  W.Gaussians = std::move(Gaussians);
  return W;
}

class RasterClockTest : public testing::Test {
protected:
  /// Does the rasterizer's next step; nothing if there is none.
  bool step(RasterClock &R, std::vector<unsigned> *Served = nullptr) {
    while (Memory.nextEvent() <= R.turn().At &&
           Memory.nextEvent() != Turn::Never) {
      std::vector<Answer> Answers;
      Memory.advance(R.turn().At, Answers);
      for (const Answer &A : Answers)
        R.answer(A);
    }
    if (R.turn().At == Turn::Never)
      return false;
    if (const auto Done = R.step(Memory); Done && Served)
      Served->push_back(Done->Agent);
    return true;
  }
  /// Runs what was queued and returns when it was done.
  uint64_t finish(RasterClock &R, std::vector<unsigned> *Served = nullptr) {
    while (step(R, Served)) {
    }
    return R.freeAt();
  }
  RasterTime timeOf(CommandWork &&W) {
    RasterClock R(P, MemoryPort(), 1, 4);
    R.begin(Now);
    R.expect(0, std::move(W));
    R.start(0, Now);
    const uint64_t End = finish(R);
    R.end(End);
    EXPECT_EQ(std::reduce(R.time().Cycles.begin(), R.time().Cycles.end()),
              End - Now)
        << "every cycle has one reason";
    Now = End + 100000; // memory goes on, and is quiet by then
    return R.time();
  }
  static uint64_t of(const RasterTime &T, RasterCycle C) {
    return T.Cycles[size_t(C)];
  }

  TimingConfig P;
  uint64_t Now = 0;
  MemorySystem Memory{P, 1};
};

TEST_F(RasterClockTest, OneGaussianOfNPixels) {
  // Rows of whole multiples of 16 pixels fill the lanes.
  for (const auto &[Width, Height] :
       {std::pair{64, 64}, {16, 1}, {32, 7}, {48, 64}}) {
    const auto Pixels = static_cast<unsigned>(Width * Height);
    const RasterTime T = timeOf(pushed({box(0, 0, Width, Height)}));
    EXPECT_EQ(of(T, RasterCycle::Blend), Pixels / 16) << Width;
    EXPECT_EQ(T.LaneSlots, Pixels);
    EXPECT_EQ(of(T, RasterCycle::Begin), P.Raster.StartCycles + 4096 / 16);
    // A pixel can be read in the cycle of its last write.
    EXPECT_EQ(of(T, RasterCycle::Flush), laneDepth({}) - 1);
  }
}

// A row of a tile begins in a row of banks (docs/rtl.md).
TEST_F(RasterClockTest, NarrowTilesAreClearedByRows) {
  for (const auto &[Width, Height, Cycles] :
       {std::tuple{4, 21, 21}, {45, 48, 3 * 48}, {17, 2, 4}, {64, 1, 4}}) {
    CommandWork W = pushed({});
    W.What.Width = Width;
    W.What.Height = Height;
    EXPECT_EQ(of(timeOf(std::move(W)), RasterCycle::Begin),
              P.Raster.StartCycles + Cycles);
  }
}

TEST_F(RasterClockTest, APixelIsNotReadWhileItIsUpdated) {
  P.Raster.UpdateCycles = 5;
  // The same pixel over and over: one blend every 5 cycles.
  EXPECT_EQ(of(timeOf(pushed(std::vector(100, box(3, 3, 1, 1)))),
               RasterCycle::Hazard),
            99U * 4);
  // Boxes side by side do not wait.
  std::vector<GaussianWork> Apart;
  for (unsigned N = 0; N != 50; ++N)
    Apart.push_back(box(N, 3, 1, 1));
  EXPECT_EQ(of(timeOf(pushed(Apart)), RasterCycle::Hazard), 0U);
  // In a large box a pixel is long done when its turn comes again.
  EXPECT_EQ(
      of(timeOf(pushed(std::vector(3, box(0, 0, 64, 2)))), RasterCycle::Hazard),
      0U);
}

TEST_F(RasterClockTest, AGaussianThatMissesTheTileTakesOneCycle) {
  const RasterTime T = timeOf(pushed(std::vector(7, box(0, 0, 0, 0))));
  EXPECT_EQ(of(T, RasterCycle::Clip), 7U);
  EXPECT_EQ(of(T, RasterCycle::Flush), 0U); // nothing is in the lanes
  EXPECT_EQ(T.Clipped, 7U);
  EXPECT_EQ(of(T, RasterCycle::Blend), 0U);
}

TEST_F(RasterClockTest, TheBufferHidesTheLatencyOfL2) {
  // All records in L2, one pixel each: how long depends on what is in flight.
  constexpr unsigned Count = 200;
  const auto Listed = [] {
    CommandWork W = pushed({});
    W.What.List = 0x100000;
    for (unsigned N = 0; N != Count; ++N) {
      GaussianWork G = box(N % 64, N / 64, 1, 1);
      G.Address = 0x200000 + N * 64;
      W.Gaussians.push_back(G);
    }
    return W;
  };
  timeOf(Listed()); // warms L2
  const auto FetchCycles = [&](unsigned Entries) {
    P.Raster.BufferEntries = Entries;
    return of(timeOf(Listed()), RasterCycle::Fetch);
  };
  // One at a time: the whole latency each but for the cycle of blending, and
  // the cut of its box.
  const uint64_t Latency = P.L2.HitCycles + P.Raster.RecordCycles;
  EXPECT_NEAR(static_cast<double>(FetchCycles(1)),
              static_cast<double>(Latency * Count), 0.2 * Latency * Count);
  // Enough entries to cover it: about nothing.
  EXPECT_LT(FetchCycles(2 * Latency), 3 * Latency);
}

TEST_F(RasterClockTest, DrainWritesALineACycle) {
  CommandWork W = pushed({});
  W.What.Drains = false;
  W.What.Output = 0x300000;
  W.What.OutputPitch = 64 * 16;
  const RasterTime T = timeOf(std::move(W));
  EXPECT_EQ(of(T, RasterCycle::Drain),
            64U * 64 * 16 / TimingLineBytes + P.Raster.PortCycles);
}

TEST_F(RasterClockTest, KeptCountsTakeALineBehindTheTile) {
  const auto Drained = [&](bool KeepsCounts, bool Fails) {
    CommandWork W = pushed({});
    W.What.KeepsCounts = KeepsCounts;
    W.What.Last = 0x300008;
    W.Status = Fails ? vorion::raster::VR_NAN : vorion::raster::VR_OK;
    return of(timeOf(std::move(W)), RasterCycle::Drain);
  };
  EXPECT_EQ(Drained(true, false), Drained(false, false) + 1);
  EXPECT_EQ(Drained(true, true), Drained(false, true));
}

TEST_F(RasterClockTest, QueuesAreServedRoundRobinInTheOrderOfTime) {
  RasterClock R(P, MemoryPort(), 4, 2);
  R.begin(0);
  const auto Start = [&](unsigned Agent, uint64_t Now) {
    R.expect(Agent, pushed({box(0, 0, 64, 64)}));
    R.start(Agent, Now);
  };
  Start(2, 0);
  Start(2, 0);
  EXPECT_TRUE(R.isFull(2));
  EXPECT_FALSE(R.isFull(0));
  step(R); // takes agent 2's first
  Start(0, 10);
  Start(3, 11);
  std::vector<unsigned> Served;
  finish(R, &Served);
  EXPECT_EQ(Served, (std::vector<unsigned>{2, 3, 0, 2}));
}

TEST_F(RasterClockTest, ACommandWaitsUntilItsWorkIsKnown) {
  RasterClock R(P, MemoryPort(), 2, 4);
  R.begin(0);
  R.start(0, 0); // not executed yet
  R.expect(1, pushed({box(0, 0, 64, 64)}));
  R.start(1, 5);
  EXPECT_FALSE(R.turn().IsKnown);
  EXPECT_EQ(R.turn().At, 0U);
  R.expect(0, pushed({box(0, 0, 64, 64)}));
  EXPECT_TRUE(R.turn().IsKnown);
  std::vector<unsigned> Served;
  finish(R, &Served);
  EXPECT_EQ(Served, (std::vector<unsigned>{0, 1}));
}

TEST_F(RasterClockTest, ACommandWithoutWorkWaitsForTheNextRun) {
  RasterClock R(P, MemoryPort(), 2, 4);
  R.begin(0);
  R.start(0, 0);
  R.expect(1, pushed({box(0, 0, 64, 64)}));
  R.start(1, 5);
  R.lastWork();
  EXPECT_TRUE(R.turn().IsKnown);
  finish(R); // the other agent's
  EXPECT_FALSE(R.isBusy(1));
  EXPECT_EQ(R.commandsLeft(), 1U);
  const uint64_t End = R.freeAt() + 1000;
  R.end(End);
  EXPECT_EQ(of(R.time(), RasterCycle::Idle), 1000U);
  R.begin(End);
  EXPECT_FALSE(R.turn().IsKnown);
  R.expect(0, pushed({box(0, 0, 64, 64)}));
  EXPECT_EQ(R.turn().At, End);
  const uint64_t Done = finish(R);
  EXPECT_EQ(R.commandsLeft(), 0U);
  R.end(Done);
  EXPECT_EQ(of(R.time(), RasterCycle::Idle), 0U);
  EXPECT_EQ(of(R.time(), RasterCycle::Blend), 256U);
}

/// A tile of \p Width x \p Height that is written to memory.
CommandWork written(unsigned Width, unsigned Height,
                    std::vector<GaussianWork> Gaussians) {
  CommandWork W;
  W.What.Width = static_cast<uint16_t>(Width);
  W.What.Height = static_cast<uint16_t>(Height);
  W.What.Output = 0x300000;
  W.What.OutputPitch = 64 * 16;
  W.Gaussians = std::move(Gaussians);
  return W;
}

class TileOverlapTest : public RasterClockTest {
protected:
  /// \p Count tiles of 1024 lines, or half as many, each with boxes that take
  /// 1536 cycles, of two agents in turn.
  RasterTime tiles(unsigned Count, unsigned Width, unsigned Overlap,
                   bool KeepsLast = false) {
    P.Raster.TileOverlap = Overlap;
    RasterClock R(P, MemoryPort(), 2, Count);
    R.begin(Now);
    std::vector<unsigned> Served, Expected;
    for (unsigned N = 0; N != Count; ++N) {
      CommandWork W = written(Width, 64, std::vector(6, box(0, 0, 64, 64)));
      W.What.KeepsLast = KeepsLast;
      W.What.Last = 0x800000;
      R.expect(N % 2, std::move(W));
      R.start(N % 2, Now);
      Expected.push_back(N % 2);
    }
    const uint64_t End = finish(R, &Served);
    EXPECT_EQ(Served, Expected);
    EXPECT_EQ(R.commandsLeft(), 0U);
    R.end(End);
    EXPECT_EQ(std::reduce(R.time().Cycles.begin(), R.time().Cycles.end()),
              End - Now);
    // Each pixel is cleared once and written once.
    EXPECT_EQ(R.laneWork().Moved, uint64_t{2} * Count * Width * 64);
    Now = End + 100000;
    return R.time();
  }
};

TEST_F(TileOverlapTest, ATileIsWrittenWhileTheNextIsBlended) {
  const RasterTime Off = tiles(5, 64, 0), On = tiles(5, 64, 2);
  EXPECT_EQ(of(Off, RasterCycle::Drain), 5U * (1024 + P.Raster.PortCycles));
  // The last one's.
  EXPECT_EQ(of(On, RasterCycle::Drain), 1024U + P.Raster.PortCycles);
  EXPECT_EQ(of(On, RasterCycle::Blend), of(Off, RasterCycle::Blend));
  EXPECT_EQ(of(On, RasterCycle::Flush), of(Off, RasterCycle::Flush));
  // It is clean when it has been written; only the first has to be cleared.
  EXPECT_EQ(of(Off, RasterCycle::Begin), 5U * (P.Raster.StartCycles + 256));
  EXPECT_EQ(of(On, RasterCycle::Begin), 5U * P.Raster.StartCycles + 256);
}

TEST_F(TileOverlapTest, HalvesOverlapTilesThatFitOne) {
  const RasterTime Off = tiles(4, 64, 0), Whole = tiles(4, 64, 1);
  EXPECT_EQ(Whole.Cycles, Off.Cycles);
  const RasterTime Halves = tiles(4, 32, 1);
  EXPECT_EQ(of(Halves, RasterCycle::Drain), 512U + P.Raster.PortCycles);
}

// A pixel with its last contributor takes two rows of a bank.
TEST_F(TileOverlapTest, HalvesDoNotFitTilesOfWidePixels) {
  const RasterTime Off = tiles(4, 32, 0, true), Halves = tiles(4, 32, 1, true);
  EXPECT_EQ(Halves.Cycles, Off.Cycles);
  const RasterTime Whole = tiles(4, 32, 2, true);
  EXPECT_LT(of(Whole, RasterCycle::Drain), of(Off, RasterCycle::Drain) / 2);
}

TEST_F(TileOverlapTest, ATileWaitsUntilTheOneBeforeIsWritten) {
  P.Raster.TileOverlap = 2;
  RasterClock R(P, MemoryPort(), 1, 8);
  R.begin(0);
  for (unsigned N = 0; N != 4; ++N) {
    R.expect(0, written(64, 64, {box(0, 0, 16, 1)}));
    R.start(0, 0);
  }
  const uint64_t End = finish(R);
  R.end(End);
  // The port writes a line a cycle, whatever is to be blended.
  EXPECT_EQ(
      of(R.time(), RasterCycle::Drain) + of(R.time(), RasterCycle::Begin) +
          of(R.time(), RasterCycle::Blend) + of(R.time(), RasterCycle::Fetch) +
          of(R.time(), RasterCycle::Hazard) + of(R.time(), RasterCycle::Flush),
      End);
  EXPECT_GE(End, 4U * 1024);
  EXPECT_LT(End, 4U * 1024 + 400);
}

TEST_F(TileOverlapTest, AnotherTurnOfTheSameAgentMayNotReadWhatIsWritten) {
  P.Raster.TileOverlap = 2;
  RasterClock R(P, MemoryPort(), 1, 8);
  R.begin(0);
  CommandWork Back;
  Back.What.Width = 32;
  Back.What.Height = 64;
  Back.What.OutputPitch = 512;
  Back.What.IsBackward = true;
  R.expect(0, written(32, 64, {box(0, 0, 16, 1)}));
  R.start(0, 0);
  R.expect(0, std::move(Back));
  R.start(0, 0);
  const uint64_t End = finish(R);
  R.end(End);
  EXPECT_FALSE(R.isBusy(0));
  EXPECT_EQ(of(R.time(), RasterCycle::Drain), 512U + P.Raster.PortCycles);
}

TEST_F(TileOverlapTest, ARunMayEndWhileATileIsWritten) {
  P.Raster.TileOverlap = 2;
  RasterClock R(P, MemoryPort(), 1, 8);
  R.begin(0);
  R.expect(0, written(64, 64, {box(0, 0, 16, 1)}));
  R.start(0, 0);
  while (R.laneWork().Moved < 4096 + 400)
    step(R);
  EXPECT_EQ(R.commandsLeft(), 1U);
  R.end(5000);
  EXPECT_GT(of(R.time(), RasterCycle::Drain), 4000U);
  R.begin(5000);
  const uint64_t End = finish(R);
  R.end(End);
  EXPECT_EQ(R.commandsLeft(), 0U);
  EXPECT_EQ(of(R.time(), RasterCycle::Drain), End - 5000);
}

TEST_F(RasterClockTest, BlocksThatAreSkippedTakeNoCycle) {
  GaussianWork G = box(0, 0, 64, 64);
  G.Blocks = 40;
  G.ChosenPixels = 40 * 16;
  const auto Of = [&] { return timeOf(pushed({G})); };
  EXPECT_EQ(of(Of(), RasterCycle::Blend), 256U) << "not asked for";
  P.Raster.SkipBlocks = 1;
  EXPECT_EQ(of(Of(), RasterCycle::Blend), 40U);
  EXPECT_EQ(Of().LaneSlots, 640U);
  // A row of blocks is tested a cycle.
  G.Blocks = 3;
  EXPECT_EQ(of(Of(), RasterCycle::Blend), 16U);
  P.Raster.Lanes = 8;
  G.Blocks = 40;
  EXPECT_EQ(of(Of(), RasterCycle::Blend), 80U);
  // Rows that lie badly for blocks are packed as ever.
  P.Raster.Lanes = 16;
  G = box(3, 3, 2, 2);
  G.Blocks = 4;
  G.ChosenPixels = 4;
  EXPECT_EQ(of(Of(), RasterCycle::Blend), 1U);
  EXPECT_EQ(Of().LaneSlots, 4U);
}

/// A backward command of \p Gaussians; every line it reads is at address 0.
CommandWork backward(std::vector<GaussianWork> Gaussians) {
  CommandWork W;
  W.What.Width = 32;
  W.What.Height = 64;
  W.What.OutputPitch = 512;
  W.What.IsBackward = true;
  W.Entries = static_cast<uint32_t>(Gaussians.size());
  W.Gaussians = std::move(Gaussians);
  return W;
}

TEST_F(RasterClockTest, BackwardAPixelTakesAPairOfLanes) {
  const RasterTime Back = timeOf(backward({box(0, 0, 32, 64)}));
  EXPECT_EQ(of(Back, RasterCycle::Blend), 2048U / 8);
  EXPECT_EQ(Back.LaneSlots, 2048U);
  EXPECT_EQ(of(Back, RasterCycle::Flush), backwardDepth({}, 0));
  EXPECT_GT(backwardDepth({}, 0), laneDepth({}));
  // Rows of 512, 512 and 128 bytes to load, a line a cycle at best.
  EXPECT_GE(of(Back, RasterCycle::Begin), 64U * (512 + 512 + 128) / 64);
}

TEST_F(RasterClockTest, EveryBatchEmptiesTheGather) {
  for (const unsigned Count : {15U, 16U, 17U, 32U})
    EXPECT_EQ(of(timeOf(backward(std::vector(Count, box(0, 0, 8, 8)))),
                 RasterCycle::Flush),
              (Count + 15) / 16 * backwardDepth({}, 0))
        << Count;
}

TEST_F(RasterClockTest, HaltsWhileTwoBatchesWait) {
  RasterClock R(P, MemoryPort(), 1, 4);
  R.begin(0);
  R.expect(0, backward(std::vector(16 * 4, box(0, 0, 8, 8))));
  R.start(0, 0);
  const auto Halt = [&] { return finish(R); };
  const uint64_t First = Halt(); // with the third batch
  EXPECT_TRUE(R.isBusy(0));
  EXPECT_TRUE(R.canTake(0));
  R.takeBatch(0, First + 1000);
  Halt();
  R.takeBatch(0, First + 1000);
  Halt();
  EXPECT_FALSE(R.isBusy(0));
  // Two batches and the end are left.
  for (unsigned Left = 3; Left != 0; --Left) {
    EXPECT_TRUE(R.canTake(0));
    R.takeBatch(0, R.freeAt());
  }
  EXPECT_TRUE(R.canTake(0)); // nothing will come
  R.end(R.freeAt());
  EXPECT_EQ(of(R.time(), RasterCycle::Drain), 1000U);
}

/// A command of triangles.
CommandWork triangles(std::vector<GaussianWork> Boxes) {
  CommandWork W;
  W.What.Width = W.What.Height = 64;
  W.What.Units.FrontEnd = 1;
  W.What.Output = 0x300000;
  W.What.OutputPitch = 64 * 8;
  W.Gaussians = std::move(Boxes);
  return W;
}

TEST_F(RasterClockTest, TrianglesHaveTheirOwnLaneAndOutput) {
  const RasterTime T = timeOf(triangles({box(0, 0, 32, 64), box(0, 0, 0, 0)}));
  EXPECT_EQ(of(T, RasterCycle::Blend), 2048U / 16);
  EXPECT_EQ(of(T, RasterCycle::Clip), 1U);
  EXPECT_EQ(of(T, RasterCycle::Flush), laneDepth({.FrontEnd = 1}) - 1 - 1);
  EXPECT_EQ(of(T, RasterCycle::Drain),
            64U * 64 * 8 / TimingLineBytes + P.Raster.PortCycles);
  EXPECT_LT(laneDepth({.FrontEnd = 1}), laneDepth({}));
}

TEST_F(RasterClockTest, RaysHaveADeeperLaneAndPixelsLikeOthers) {
  CommandWork W = triangles({box(0, 0, 32, 64)});
  const RasterTime Conics = timeOf([&] {
    CommandWork C = W;
    C.What.Units.FrontEnd = 0;
    C.What.OutputPitch = 64 * 16;
    return C;
  }());
  W.What.Units.FrontEnd =
      vorion::raster::frontEndRowOf(vorion::raster::VR_PRIMITIVE_RAY);
  W.What.OutputPitch = 64 * 16;
  const vorion::raster::LaneUnits Units = W.What.Units;
  const RasterTime T = timeOf(std::move(W));
  EXPECT_EQ(of(T, RasterCycle::Blend), of(Conics, RasterCycle::Blend));
  EXPECT_EQ(of(T, RasterCycle::Drain), of(Conics, RasterCycle::Drain));
  // By a divider and a stage.
  EXPECT_EQ(of(T, RasterCycle::Flush), of(Conics, RasterCycle::Flush) + 9);
  EXPECT_EQ(laneDepth(Units), laneDepth({}) + 9);
  EXPECT_GT(laneArea(Units), laneArea({}));
}

TEST_F(RasterClockTest, LoadedDepthsAreReadFirst) {
  const auto BeginOf = [&](bool Loads) {
    CommandWork W = triangles({});
    W.What.Depth.Loads = Loads;
    return of(timeOf(std::move(W)), RasterCycle::Begin);
  };
  EXPECT_GE(BeginOf(true), BeginOf(false) + 64U * 64 * 8 / TimingLineBytes -
                               64U * 64 / P.Raster.Banks);
}

// A word a pixel: 128 bytes of each row of a tile of 32 x 64 pixels.
TEST_F(RasterClockTest, RangesAndPixelsAreReadFirst) {
  const auto BeginOf = [&](bool IsLimited, bool StartsLate, bool LoadsPixels) {
    CommandWork W = pushed({});
    W.What.Width = 32;
    W.What.OutputPitch = 1024;
    W.What.IsLimited = IsLimited;
    W.What.StartsLate = StartsLate;
    W.What.LoadsPixels = LoadsPixels;
    return of(timeOf(std::move(W)), RasterCycle::Begin);
  };
  const uint64_t None = BeginOf(false, false, false);
  constexpr uint64_t Lines = 64U * 32 * 4 / TimingLineBytes;
  const uint64_t Cleared = 64U * 32 / P.Raster.Banks;
  EXPECT_GE(BeginOf(true, false, false), None + Lines - Cleared);
  EXPECT_GE(BeginOf(true, true, false), None + 2 * Lines - Cleared);
  EXPECT_GE(BeginOf(true, true, true), None + 6 * Lines - Cleared);
}

TEST_F(RasterClockTest, FragmentsHaltWhileTwoBatchesWait) {
  RasterClock R(P, MemoryPort(), 1, 4);
  R.begin(0);
  std::vector<GaussianWork> Boxes(2, box(0, 0, 16, 4));
  Boxes[0].ChosenPixels = 40; // two batches, and a half
  Boxes[1].ChosenPixels = 10; // the third, and 2 of a fourth
  CommandWork W = triangles(Boxes);
  W.What.HandsFragments = true;
  R.expect(0, std::move(W));
  R.start(0, 0);
  const uint64_t First = finish(R); // with the third batch
  EXPECT_TRUE(R.isBusy(0));
  R.takeBatch(0, First + 1000);
  const uint64_t Second = finish(R); // with the fourth
  EXPECT_TRUE(R.isBusy(0));
  R.takeBatch(0, Second + 1000);
  finish(R);
  EXPECT_FALSE(R.isBusy(0));
  for (unsigned Left = 3; Left != 0; --Left) { // two batches and the end
    EXPECT_TRUE(R.canTake(0));
    R.takeBatch(0, R.freeAt());
  }
  R.end(R.freeAt());
  EXPECT_EQ(of(R.time(), RasterCycle::Drain), 2000U);
  EXPECT_EQ(R.laneWork().Covered[1], 128U);
}

TEST_F(RasterClockTest, TheEndOfACommandMakesNoRoomForABatch) {
  RasterClock R(P, MemoryPort(), 1, 4);
  R.begin(0);
  for (const unsigned Batches : {1U, 2U}) {
    R.expect(0, backward(std::vector(16 * Batches, box(0, 0, 8, 8))));
    R.start(0, 0);
  }
  const uint64_t First = finish(R); // with the second's last batch
  R.takeBatch(0, First);            // one batch is left, and an end before it
  finish(R);
  EXPECT_FALSE(R.isBusy(0));
  // The same with two batches behind the end.
  R.expect(0, backward({box(0, 0, 8, 8)}));
  R.start(0, R.freeAt());
  finish(R);
  EXPECT_TRUE(R.isBusy(0));
  R.takeBatch(0, R.freeAt()); // the end of the first
  EXPECT_EQ(R.turn().At, Turn::Never);
  R.takeBatch(0, R.freeAt()); // a batch
  EXPECT_NE(R.turn().At, Turn::Never);
}

TEST_F(RasterClockTest, ARunThatEndsInAHaltDrains) {
  RasterClock R(P, MemoryPort(), 1, 4);
  R.begin(0);
  R.expect(0, backward(std::vector(16 * 3, box(0, 0, 8, 8))));
  R.start(0, 0);
  const uint64_t Halted = finish(R);
  R.end(Halted + 1000);
  EXPECT_EQ(of(R.time(), RasterCycle::Drain), 1000U);
}

TEST_F(RasterClockTest, AnAnswerBehindAHandOverHandsNothingOverAgain) {
  // A list's next line is asked for a line ahead, so that its answer comes at
  // any moment of what is done with the batch before.
  constexpr unsigned Batches = 40;
  for (unsigned Height = 0; Height != 8; ++Height) {
    GaussianWork G = box(0, 0, Height ? 8 : 0, Height);
    G.Address = 0x100000;
    CommandWork W = backward(std::vector(16 * Batches, G));
    W.What.List = 0x8000000 + 0x10000 * Height;
    RasterClock R(P, MemoryPort(), 1, 4);
    R.begin(Now);
    R.expect(0, std::move(W));
    R.start(0, Now);
    while (R.isBusy(0)) {
      step(R);
      if (R.isBusy(0) && R.canTake(0))
        R.takeBatch(0, R.freeAt());
    }
    R.end(finish(R));
    EXPECT_EQ(of(R.time(), RasterCycle::Flush), Batches * backwardDepth({}, 0))
        << Height;
    Now = R.freeAt() + 100000;
  }
}

/// What a rasterizer does is told in parts, each before or after the clock has
/// got that far.
class RasterPartsTest : public RasterClockTest {
protected:
  /// When a command was done that is told in parts of \p Length Gaussians, each
  /// when the clock needs it.
  RasterTime timeInParts(CommandWork W, size_t Length) {
    RasterClock R(P, MemoryPort(), 1, 4);
    R.begin(Now);
    R.start(0, Now);
    const std::vector<GaussianWork> All = std::exchange(W.Gaussians, {});
    const CommandWork Begun = W;
    for (size_t Told = 0; Told + Length < All.size(); Told += Length) {
      const auto From = All.begin() + static_cast<ptrdiff_t>(Told);
      R.expectPart(0, Begun, {From, From + static_cast<ptrdiff_t>(Length)});
      R.refresh();
      while (R.turn().IsKnown && step(R)) {
      }
      EXPECT_FALSE(R.turn().IsKnown) << "it waits for the next part";
      W.Gaussians.assign(From + static_cast<ptrdiff_t>(Length), All.end());
    }
    R.expect(0, std::move(W));
    R.refresh();
    const uint64_t End = finish(R);
    R.end(End);
    Now = End + 100000;
    return R.time();
  }
};

TEST_F(RasterPartsTest, TakeTheSameTime) {
  std::vector<GaussianWork> Boxes;
  for (unsigned N = 0; N != 50; ++N)
    Boxes.push_back(box(N % 8, N % 5, 1 + N % 30, 1 + N % 20));
  const RasterTime Whole = timeOf(written(64, 64, Boxes));
  for (const size_t Length : {1U, 7U, 16U, 49U}) {
    const RasterTime Parts = timeInParts(written(64, 64, Boxes), Length);
    EXPECT_EQ(Parts.Cycles, Whole.Cycles) << Length;
    EXPECT_EQ(Parts.LaneSlots, Whole.LaneSlots);
  }
}

TEST_F(RasterPartsTest, OfABackwardCommandAreItsBatches) {
  const auto Boxes = std::vector(16 * 2 + 5, box(0, 0, 8, 8));
  const RasterTime Whole = timeOf(backward(Boxes));
  // The last entries of the list come first, 5 of them in the first batch.
  RasterClock R(P, MemoryPort(), 1, 4);
  R.begin(Now);
  CommandWork W = backward({});
  W.Entries = 16 * 2 + 5;
  R.expectPart(0, W, std::vector(5, box(0, 0, 8, 8)));
  R.expectPart(0, W, std::vector(16, box(0, 0, 8, 8)));
  R.start(0, Now);
  while (R.turn().IsKnown && step(R)) {
  }
  W.Gaussians.assign(16, box(0, 0, 8, 8));
  R.expect(0, std::move(W));
  R.refresh();
  finish(R);
  R.takeBatch(0, R.freeAt());
  const uint64_t End = finish(R);
  R.end(End);
  EXPECT_FALSE(R.isBusy(0));
  EXPECT_EQ(R.time().LaneSlots, Whole.LaneSlots);
  EXPECT_EQ(of(R.time(), RasterCycle::Flush), of(Whole, RasterCycle::Flush));
}

TEST_F(RasterPartsTest, AreForgottenOnceTheyAreTimed) {
  constexpr size_t Length = 100;
  RasterClock R(P, MemoryPort(), 1, 4, Length * sizeof(GaussianWork));
  R.begin(0);
  R.start(0, 0);
  CommandWork W = written(64, 64, {});
  for (unsigned Part = 0; Part != 20; ++Part) {
    EXPECT_TRUE(R.hasRoom());
    R.expectPart(0, W, std::vector(Length, box(0, 0, 4, 4)));
    EXPECT_FALSE(R.hasRoom());
    R.refresh();
    while (R.turn().IsKnown && step(R)) {
    }
  }
  R.expect(0, std::move(W));
  R.refresh();
  R.end(finish(R));
  EXPECT_EQ(R.time().Gaussians, 20 * Length);
}

TEST_F(RasterPartsTest, AFullClockTakesWhatItKnowsOutOfTurn) {
  RasterClock R(P, MemoryPort(), 2, 4, 10 * sizeof(GaussianWork));
  R.begin(0);
  R.start(0, 0); // of this one nothing is known
  R.start(1, 0);
  EXPECT_FALSE(R.turn().IsKnown);
  R.expect(1, written(64, 64, std::vector(10, box(0, 0, 4, 4))));
  EXPECT_TRUE(R.turn().IsKnown);
  while (R.turn().IsKnown && step(R)) {
  }
  EXPECT_TRUE(R.hasRoom());
  EXPECT_EQ(R.outOfTurn(), 1U);
  EXPECT_FALSE(R.isBusy(1));
  R.expect(0, written(64, 64, {box(0, 0, 4, 4)}));
  R.end(finish(R));
  EXPECT_FALSE(R.isBusy(0));
}

} // namespace
