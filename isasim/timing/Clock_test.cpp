/// The clock on programs whose time is known.
#include "testing/TimedPrograms.h"
#include "timing/common/Turns.h"
#include "timing/memory/DramChannels.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

TEST_F(ClockTest, DependentAndPipelinedOperations) {
  const CoreTiming &P = Settings.Timing.Core;
  constexpr unsigned N = 100;
  EXPECT_EQ(cost(N, {addi(10, 10, 1)}), N * P.AluLatency);
  const Words Dependent = {
      encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 1, .Rs2 = 2})};
  EXPECT_EQ(cost(N, Dependent), N * P.FmaLatency - (P.FmaLatency - 1))
      << "the last result is waited for by nobody";
  const Words Independent = {
      encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 5, .Rs2 = 6}),
      encode(Op::RV_FADD_S, {.Rd = 2, .Rs1 = 5, .Rs2 = 6}),
      encode(Op::RV_FADD_S, {.Rd = 3, .Rs1 = 5, .Rs2 = 6}),
      encode(Op::RV_FADD_S, {.Rd = 4, .Rs1 = 5, .Rs2 = 6})};
  EXPECT_EQ(cost(N, Independent), 4U * N);
  // The divider is not pipelined.
  const Words Divisions = {encode(Op::RV_DIV, {.Rd = 10, .Rs1 = 6, .Rs2 = 6}),
                           encode(Op::RV_DIV, {.Rd = 11, .Rs1 = 6, .Rs2 = 6})};
  EXPECT_EQ(cost(N, Divisions), (2U * N - 1) * P.DivInterval + 1 +
                                    // the end of the program is an SFU's too
                                    P.DivInterval - 1);
}

TEST_F(ClockTest, TakenBranchesCostThePenalty) {
  const unsigned Penalty = Settings.Timing.Core.BranchPenalty;
  const Words Loop = {addi(10, 0, 50), addi(10, 10, -1),
                      encode(Op::RV_BNE, {.Rs1 = 10, .Rs2 = 0, .Imm = -4})};
  // 50 times two instructions, 49 times back; the branch waits for nothing.
  EXPECT_EQ(cost(1, Loop), 1 + 50 * 2 + 49 * Penalty);
}

TEST_F(ClockTest, DivergencePaysForTheFrontEnd) {
  // Half of the lanes add one, the other half two.
  const Words Split = {encode(Op::RV_ANDI, {.Rd = 10, .Rs1 = 6, .Imm = 1}),
                       encode(Op::VX_SPLIT, {.Rd = 11, .Rs1 = 10}),
                       encode(Op::RV_BEQ, {.Rs1 = 10, .Rs2 = 0, .Imm = 12}),
                       addi(12, 12, 1),
                       encode(Op::RV_JAL, {.Rd = 0, .Imm = 8}),
                       addi(12, 12, 2),
                       encode(Op::VX_JOIN, {.Rs1 = 11})};
  const TimeReport R = run(Split);
  // Into the split, to the other side, and together again.
  EXPECT_EQ(of(R, CoreCycle::Divergence) - of(run({}), CoreCycle::Divergence),
            3U * Settings.Timing.Core.MaskPenalty);
  EXPECT_EQ(activity(R, "core lane instructions", "branch"), 8U * 2 + 8);
}

TEST_F(ClockTest, LoadsThatHitInL2) {
  const TimingConfig &P = Settings.Timing;
  constexpr unsigned N = 50;
  const Words Warm = {lw(10, 0, 7), addi(10, 10, 0)};
  // Each address needs the value before: zero, added to the address.
  const Words Chase = {lw(10, 0, 7),
                       encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 10})};
  EXPECT_EQ(cost(N, Chase, Warm),
            N * (P.Core.AguCycles + P.L2.HitCycles + P.Core.AluLatency));
  // Without dependence the queue is the limit: so many in a latency.
  const Words Stream = {lw(10, 0, 7), lw(11, 0, 7), lw(12, 0, 7), lw(13, 0, 7),
                        lw(14, 0, 7), lw(15, 0, 7), lw(16, 0, 7), lw(17, 0, 7)};
  Settings.Timing.Core.LsuQueue = 2;
  const double Expected = 8.0 * N * (1 + 10) / 2;
  EXPECT_NEAR(static_cast<double>(cost(N, Stream, Warm)), Expected,
              0.1 * Expected);
}

TEST_F(ClockTest, StridesDecideHowManyLinesAreRequested) {
  for (const unsigned Shift : {0U, 2U, 4U, 6U}) {
    // Lane * 2^shift behind a line's beginning.
    const Words Body = {
        lui(7, 0x100000),
        encode(Op::RV_SLLI,
               {.Rd = 10, .Rs1 = 6, .Imm = static_cast<int>(Shift)}),
        encode(Op::RV_ANDI, {.Rd = 10, .Rs1 = 10, .Imm = -4}),
        encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 10}), lw(11, 0, 7)};
    const unsigned Lines = std::max(1U, (16U << Shift) / TimingLineBytes);
    EXPECT_EQ(activity(run(Body), "lsu", "lines requested"), Lines) << Shift;
  }
}

TEST_F(ClockTest, LocalBanksConflict) {
  constexpr unsigned N = 64;
  for (const unsigned Shift : {0U, 1U, 2U, 3U, 4U}) {
    const Words Before = {
        lui(8, VX_LOCAL_BASE),
        encode(Op::RV_SLLI,
               {.Rd = 10, .Rs1 = 6, .Imm = static_cast<int>(Shift + 2)}),
        encode(Op::RV_ADD, {.Rd = 8, .Rs1 = 8, .Rs2 = 10})};
    // Words 2^shift apart: so many of a bank.
    const unsigned Conflicts = 1U << Shift;
    const Words Loads = {lw(10, 0, 8), lw(11, 0, 8), lw(12, 0, 8),
                         lw(13, 0, 8)};
    EXPECT_NEAR(static_cast<double>(cost(N, Loads, Before)),
                4.0 * N * Conflicts, Conflicts + 4)
        << Shift;
  }
  // 16 words of three banks: one bank has six of them.
  Settings.Timing.Core.LocalBanks = 3;
  EXPECT_EQ(
      activity(run(Words{lui(8, VX_LOCAL_BASE),
                         encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 2}),
                         encode(Op::RV_ADD, {.Rd = 8, .Rs1 = 8, .Rs2 = 10}),
                         lw(10, 0, 8)}),
               "local memory", "conflict cycles"),
      5U);
  // The same word for all is one access.
  const Words Same = {lw(10, 0, 8)};
  EXPECT_EQ(activity(run(Words{lui(8, VX_LOCAL_BASE)} + Same), "local memory",
                     "conflict cycles"),
            0U);
}

TEST_F(ClockTest, StacksAreInterleaved) {
  // Every lane's stack pointer, and a word there.
  const Words Body = {csrr(10, CSR_STACK_SIZE),
                      csrr(11, CSR_MHARTID),
                      encode(Op::RV_MUL, {.Rd = 10, .Rs1 = 10, .Rs2 = 11}),
                      lui(12, VX_LOCAL_BASE),
                      encode(Op::RV_SUB, {.Rd = 12, .Rs1 = 12, .Rs2 = 10}),
                      sw(6, -16, 12)};
  EXPECT_EQ(activity(run(Body), "lsu", "lines requested"), 1U);
  Settings.Timing.Core.InterleavedStacks = 0;
  EXPECT_EQ(activity(run(Body), "lsu", "lines requested"), 16U);
}

TEST_F(ClockTest, AFenceWaitsForWhatIsInFlight) {
  const Words Body = {lw(10, 0, 7), encode(Op::RV_FENCE, {})};
  EXPECT_GT(of(run(Body), CoreCycle::Fence), Settings.Timing.L2.HitCycles);
}

// Nothing else gets longer by a link than the waits for it.
TEST_F(ClockTest, WaitingForTheLinkIsAReason) {
  const Words Warm = {lw(10, 0, 7), encode(Op::RV_FENCE, {})};
  const Words Chain = repeat(20, {lw(10, 0, 7), addi(10, 10, 1)});
  const Words Fences =
      repeat(20, {sw(10, 0, 7), lw(11, 0, 7), encode(Op::RV_FENCE, {})});
  const Words Queue = repeat(40, {lw(10, 0, 7)});
  for (const Words &Body : {Chain, Fences, Queue}) {
    Settings.Timing.Link = {};
    const TimeReport None = run(Warm + Body);
    EXPECT_EQ(of(None, CoreCycle::Link), 0U);
    Settings.Timing.Link = {.ToL2Ns = 100, .FromL2Ns = 40};
    const TimeReport R = run(Warm + Body);
    const uint64_t Link = of(R, CoreCycle::Link);
    // Behind the last instruction it is the run that waits.
    const uint64_t Longer = R.Cycles - of(R, CoreCycle::Ended) -
                            (None.Cycles - of(None, CoreCycle::Ended));
    EXPECT_NEAR(static_cast<double>(Longer), static_cast<double>(Link), 1);
    EXPECT_GT(Longer, 20 * 140 * R.ClockMhz / 1000);
  }
}

TEST_F(ClockTest, RefreshesOfDramThatNobodyAsksAreCounted) {
  // 102,400 rounds that access no memory.
  const TimeReport R = run({lui(10, 0x19000), addi(10, 10, -1),
                            encode(Op::RV_BNE, {.Rs1 = 10, .Imm = -4})});
  const dram::TimingTable T = setUpDram(Settings.Timing.Dram)->Table;
  const double Ps = 1e6 * static_cast<double>(R.Cycles) / R.ClockMhz;
  EXPECT_NEAR(static_cast<double>(activity(R, "dram", "refreshes")),
              Settings.Timing.Dram.Channels * Ps / T.TickPs / T.RefreshInterval,
              Settings.Timing.Dram.Channels);
  EXPECT_EQ(activity(R, "dram", "activations"), 0U);
}

TEST_F(ClockTest, DramTimeDoesNotScaleWithTheClock) {
  // A miss in an otherwise empty program.
  const Words Body = {lw(10, 0, 7), addi(10, 10, 0)};
  const auto Nanoseconds = [&](uint32_t Mhz) {
    Settings.Timing.ClockMhz = Mhz;
    const TimeReport R = run(Body);
    return 1e3 * static_cast<double>(of(R, CoreCycle::Memory)) / Mhz;
  };
  const TimingConfig &P = Settings.Timing;
  const double Cycles = P.Core.AguCycles + P.L2.HitCycles + P.Llc.HitCycles - 1;
  const dram::TimingTable T = setUpDram(P.Dram)->Table;
  const uint32_t Ticks =
      T.CommandTicks[size_t(dram::Command::Activate)] +
      T.sameBank(dram::Command::Activate, dram::Command::Read) + T.ReadLatency +
      2 * T.BurstTicks;
  const double Dram = (P.Dram.ControllerPs + 1.0 * Ticks * T.TickPs) / 1000;
  for (const uint32_t Mhz : {100U, 530U, 5000U})
    EXPECT_NEAR(Nanoseconds(Mhz), 1e3 * Cycles / Mhz + Dram,
                T.TickPs / 1e3 + 2e3 / Mhz)
        << Mhz;
}

TEST_F(ClockTest, AtomicsOfOneWordTakeTurns) {
  const Words OneWord = {
      lui(7, 0x100000), encode(Op::RV_AMOADD_W, {.Rd = 10, .Rs1 = 7, .Rs2 = 6}),
      addi(10, 10, 0)};
  const Words Apart = {encode(Op::RV_AMOADD_W, {.Rd = 10, .Rs1 = 7, .Rs2 = 6}),
                       addi(10, 10, 0)};
  const Words Warm = {lw(10, 0, 7), encode(Op::RV_FENCE, {})};
  EXPECT_EQ(run(Warm + OneWord).Cycles, run(Warm + Apart).Cycles + 1 + 15)
      << "15 more turns, and the lui";
}

TEST_F(ClockTest, BothWordsOfAPairAreWaitedFor) {
  // x6 is 0 to 15; local memory is zero, so lane 0 alone swaps.
  const auto Use = [&](unsigned Register) {
    return cost(1, {addi(12, 0, 0), addi(13, 0, 0), lui(8, VX_LOCAL_BASE),
                    encode(Op::RV_AMOCAS_D, {.Rd = 12, .Rs1 = 8, .Rs2 = 0}),
                    addi(14, Register, 0)});
  };
  EXPECT_GT(Use(12), Use(15));
  EXPECT_EQ(Use(13), Use(12));
  // Likewise both words that are written.
  const auto Give = [&](unsigned Register) {
    return cost(1, {addi(12, 0, 0), addi(13, 0, 0), lui(8, VX_LOCAL_BASE),
                    encode(Op::RV_DIV, {.Rd = Register, .Rs1 = 6, .Rs2 = 6}),
                    encode(Op::RV_AMOCAS_D, {.Rd = 12, .Rs1 = 8, .Rs2 = 10})});
  };
  EXPECT_GT(Give(10), Give(15));
  EXPECT_EQ(Give(11), Give(10));
  EXPECT_EQ(Give(13), Give(12));
}

TEST_F(ClockTest, CoresWaitAtABarrier) {
  Settings = timed(4);
  // Core n does 100 n additions, then all meet.
  const Words Body = Words{csrr(10, CSR_CORE_ID)} + countThenMeet(4);
  const TimeReport R = run(Body);
  EXPECT_EQ(of(R, CoreCycle::Barrier, 3), 0U);
  for (unsigned Core = 0; Core != 3; ++Core)
    EXPECT_EQ(of(R, CoreCycle::Barrier, Core),
              (3 - Core) * 100U * (2 + Settings.Timing.Core.BranchPenalty));
}

/// A tile of 64 x 64 without Gaussians.
Words emptyTile() {
  return {lui(14, 0x200000),
          csrw(raster::Csr::Output, 14),
          addi(14, 0, 1024),
          csrw(raster::Csr::OutputPitch, 14),
          lui(14, 0x400000),
          addi(14, 14, 64),
          csrw(raster::Csr::TileShape, 14)};
}

TEST_F(ClockTest, AFullQueueStallsTheStart) {
  Settings.Raster.QueueDepth = 2;
  const unsigned Tile = Settings.Timing.Raster.StartCycles + 4096 / 16 + 1024;
  const Words Start = {csrw(raster::Csr::Start, 0)};
  const Words Wait = {csrr(15, raster::Csr::Wait)};
  // A second warp, which nobody starts, changes nothing.
  for (const unsigned Warps : {1U, 2U}) {
    Settings.WarpsPerCore = Warps;
    const TimeReport Two = run(emptyTile() + repeat(2, Start));
    EXPECT_EQ(of(Two, CoreCycle::RasterFull), 0U) << Warps;
    const TimeReport Five = run(emptyTile() + repeat(5, Start) + Wait);
    EXPECT_NEAR(static_cast<double>(of(Five, CoreCycle::RasterFull)),
                3.0 * Tile, 8)
        << Warps;
    EXPECT_EQ(Five.Rasters[0].Commands, 5U) << Warps;
    const TimeReport Waited = run(emptyTile() + Start + Wait);
    EXPECT_NEAR(static_cast<double>(of(Waited, CoreCycle::RasterWait)), Tile, 2)
        << Warps;
  }
}

// n cycles of the rasterizer that a run starts and a later one of m cycles
// waits for take the longer of the two, counted from the start.
TEST_F(ClockTest, TilesOutliveTheirRun) {
  const unsigned Tile = Settings.Timing.Raster.StartCycles + 4096 / 16 + 1024;
  const Words Start = emptyTile() + Words{csrw(raster::Csr::Start, 0)};
  const Words Wait = {csrr(15, raster::Csr::Wait)};
  for (const unsigned Adds : {10U, 500U, 3000U}) {
    auto M = Machine::create(Settings);
    ASSERT_TRUE(M);
    const auto Run = [&](const Words &Body) {
      (*M)->load(codeImage(program(Body)));
      const TimeReport R = *(*M)->run().Time;
      for (const RasterTime &T : R.Rasters)
        EXPECT_EQ(std::reduce(T.Cycles.begin(), T.Cycles.end()), R.Cycles)
            << "every cycle has one reason";
      return R;
    };
    const TimeReport First = Run(Start);
    EXPECT_EQ(First.CommandsLeft, 1U);
    EXPECT_LT(First.Cycles, Tile / 4);
    const TimeReport Second = Run(repeat(Adds, {addi(10, 10, 1)}) + Wait);
    EXPECT_EQ(Second.CommandsLeft, 0U);
    const uint64_t Idle = First.Rasters[0].Cycles[size_t(RasterCycle::Idle)];
    const uint64_t Left = Idle + Tile - First.Cycles;
    const uint64_t Alone = run(repeat(Adds, {addi(10, 10, 1)}) + Wait).Cycles;
    EXPECT_NEAR(static_cast<double>(Second.Cycles),
                static_cast<double>(std::max<uint64_t>(Left, Alone)), 8)
        << Adds;
    // All of the tile is in the two reports.
    const auto Busy = [](const TimeReport &R) {
      return R.Cycles - R.Rasters[0].Cycles[size_t(RasterCycle::Idle)];
    };
    EXPECT_NEAR(static_cast<double>(Busy(First) + Busy(Second)), Tile, 2);
  }
}

// What a run left keeps its places in the queue.
TEST_F(ClockTest, AQueueStaysFullFromRunToRun) {
  Settings.Raster.QueueDepth = 2;
  const unsigned Tile = Settings.Timing.Raster.StartCycles + 4096 / 16 + 1024;
  auto M = Machine::create(Settings);
  ASSERT_TRUE(M);
  const Words Start = {csrw(raster::Csr::Start, 0)};
  (*M)->load(codeImage(program(emptyTile() + repeat(2, Start))));
  EXPECT_EQ((*M)->run().Time->CommandsLeft, 2U);
  const TimeReport Next = *(*M)->run().Time;
  EXPECT_EQ(Next.CommandsLeft, 2U);
  EXPECT_NEAR(static_cast<double>(of(Next, CoreCycle::RasterFull)), 2.0 * Tile,
              100);
}

/// Two backward commands of three batches each. Cores spin before they start
/// them and, 256 times as long, before they take what comes; the first longest.
Words gradients() {
  const Words Spin = {addi(13, 13, -1), // loop
                      encode(Op::RV_BNE, {.Rs1 = 13, .Rs2 = 0, .Imm = -4})};
  const uint32_t Next = csrr(19, raster::Csr::GradNext);
  return Words{lui(14, 0x200000),
               csrw(raster::Csr::Gaussians, 14),
               csrw(raster::Csr::List, 14),
               lui(14, 0x240000),
               csrw(raster::Csr::Output, 14),
               lui(14, 0x280000),
               csrw(raster::Csr::Upstream, 14),
               lui(14, 0x2c0000),
               csrw(raster::Csr::Last, 14),
               addi(15, 0, 48),
               sw(15, 0, 14),
               csrw(raster::Csr::Count, 15),
               addi(14, 0, 512),
               csrw(raster::Csr::OutputPitch, 14),
               lui(14, 0x400000),
               addi(14, 14, 32),
               csrw(raster::Csr::TileShape, 14),
               addi(14, 0, 1),
               csrw(raster::Csr::Mode, 14),
               csrr(12, CSR_MHARTID),
               encode(Op::RV_ANDI, {.Rd = 12, .Rs1 = 12, .Imm = 0x30}),
               encode(Op::RV_XORI, {.Rd = 12, .Rs1 = 12, .Imm = 0x3f}),
               addi(13, 12, 0)} +
         Spin +
         Words{csrw(raster::Csr::Start, 0), csrw(raster::Csr::Start, 0),
               encode(Op::RV_SLLI, {.Rd = 13, .Rs1 = 12, .Imm = 8})} +
         Spin + repeat(8, {Next}) + Words{csrr(19, raster::Csr::Wait)};
}

// The machine's rasterizer, halted by the first core's batches, has not
// executed the others' commands when the clock wants to serve them.
TEST_F(ClockTest, CommandsBehindAHaltedOneAreWaitedFor) {
  Settings = timed(4);
  Settings.Quantum = 1024;
  std::vector<std::string> Reports;
  for (const unsigned Threads : {1U, 2U, 8U}) {
    Settings.HostThreads = Threads;
    const TimeReport R = run(gradients());
    Reports.push_back(toJson(R));
    EXPECT_EQ(Reports.back(), Reports.front()) << Threads;
    EXPECT_EQ(R.OutOfOrder, 0U);
    EXPECT_EQ(R.CommandsLeft, 0U);
    EXPECT_EQ(R.Rasters[0].Commands, 8U);
    EXPECT_EQ(R.Rasters[0].Gaussians, 8U * 48);
    // The first core's spinning, and a little.
    const uint64_t Spin =
        (0x3fU << 8) * (2 + Settings.Timing.Core.BranchPenalty);
    EXPECT_GT(R.Cycles, Spin);
    EXPECT_LT(R.Cycles, Spin + Spin / 2);
    EXPECT_GT(R.Rasters[0].Cycles[size_t(RasterCycle::Drain)], Spin / 2);
  }
}

/// Lanes of all cores draw numbers from one counter, use local memory, spin
/// through loops of different lengths, and start tiles.
Words everything() {
  return emptyTile() +
         Words{csrr(12, CSR_MHARTID),
               lui(10, 0x100000),
               encode(Op::RV_ANDI, {.Rd = 13, .Rs1 = 12, .Imm = 0x70}),
               addi(13, 13, 5),
               addi(14, 0, 1), // loop
               encode(Op::RV_AMOADD_W, {.Rd = 15, .Rs1 = 10, .Rs2 = 14}),
               encode(Op::RV_SH2ADD, {.Rd = 16, .Rs1 = 15, .Rs2 = 10}),
               sw(12, 64, 16),
               sw(15, 0, 8),
               lw(17, 0, 8),
               encode(Op::RV_MUL, {.Rd = 18, .Rs1 = 17, .Rs2 = 12}),
               sw(18, 2000, 7),
               addi(13, 13, -1),
               encode(Op::RV_BNE, {.Rs1 = 13, .Rs2 = 0, .Imm = -9 * 4}),
               csrw(raster::Csr::Start, 0),
               csrw(raster::Csr::Start, 0),
               csrr(19, raster::Csr::Wait)};
}

TEST(Clock, TheFirstOfAllTurnsIsTheLowestOfTheEarliest) {
  constexpr unsigned Count = 13;
  Turns All;
  All.assign(Count);
  std::vector<Turn> Each(Count);
  uint32_t State = 1;
  for (unsigned N = 0; N != 2000; ++N) {
    State = State * 1664525 + 1013904223;
    const unsigned Who = (State >> 16) % Count;
    Each[Who] = State >> 30 ? Turn(State >> 24 & 7, State >> 28 & 1) : Turn();
    All.set(Who, Each[Who]);
    const auto First = std::min_element(Each.begin(), Each.end());
    ASSERT_EQ(All.first(), static_cast<unsigned>(First - Each.begin()));
    ASSERT_EQ(All[Who], Each[Who]);
  }
}

TEST(Clock, ChangesNothing) {
  Config Settings = timed(4);
  Settings.SocketsPerCluster = 2;
  std::vector<std::byte> Memory[2];
  CoreCounters Total[2];
  for (const bool Enabled : {false, true}) {
    Settings.Timing.Enabled = Enabled;
    auto M = Machine::create(Settings);
    ASSERT_TRUE(M);
    (*M)->load(codeImage(program(everything())));
    const RunResult R = (*M)->run();
    EXPECT_EQ(R.End, Outcome::Done) << R.Report;
    EXPECT_EQ(R.Time.has_value(), Enabled);
    Memory[Enabled].resize(Settings.GlobalBytes);
    ASSERT_TRUE((*M)->read(VX_GLOBAL_BASE, Memory[Enabled]));
    Total[Enabled] = R.Total;
  }
  EXPECT_EQ(Memory[0], Memory[1]);
  EXPECT_EQ(Total[0].WarpInstructions, Total[1].WarpInstructions);
  EXPECT_EQ(Total[0].LaneInstructions, Total[1].LaneInstructions);
}

TEST(Clock, TakesNoNoticeOfRunsWithoutIt) {
  const auto Reports = [](bool Between) {
    auto M = Machine::create(timed(4));
    EXPECT_TRUE(M);
    (*M)->load(codeImage(program(everything())));
    std::string Text = toJson(*(*M)->run().Time);
    if (Between) {
      (*M)->setClocking(Clocking::Off);
      EXPECT_FALSE((*M)->run().Time);
      EXPECT_FALSE((*M)->run().Time);
      (*M)->setClocking(Clocking::On);
    }
    return Text + toJson(*(*M)->run().Time);
  };
  EXPECT_EQ(Reports(true), Reports(false));
}

TEST(Clock, IsTheSameForAnyNumberOfHostThreads) {
  Config Settings = timed(4);
  Settings.SocketsPerCluster = 2;
  Settings.Clusters = 2;
  std::vector<std::string> Reports;
  for (const unsigned Threads : {1U, 2U, 3U, 8U}) {
    Settings.HostThreads = Threads;
    auto M = Machine::create(Settings);
    ASSERT_TRUE(M);
    (*M)->load(codeImage(program(everything())));
    // The second run begins with warm caches.
    Reports.push_back(toJson(*(*M)->run().Time) + toJson(*(*M)->run().Time));
    // The last of these waits for what the others left.
    Words NoWait = everything();
    NoWait.pop_back();
    (*M)->load(codeImage(program(NoWait)));
    Reports.back() += toJson(*(*M)->run().Time) + toJson(*(*M)->run().Time);
    (*M)->load(codeImage(program(everything())));
    Reports.back() += toJson(*(*M)->run().Time);
    EXPECT_EQ(Reports.back(), Reports.front()) << Threads;
  }
}

TEST(Clock, QuantumDoesNotMatter) {
  // Where cores share nothing but memory, taking the trace in other pieces
  // must give the same time.
  Config Settings = timed(4);
  const Words Body = {addi(13, 0, 400),
                      lw(10, 0, 7),
                      addi(7, 7, 64),
                      encode(Op::RV_ADD, {.Rd = 11, .Rs1 = 11, .Rs2 = 10}),
                      sw(11, 1024, 7),
                      addi(13, 13, -1),
                      encode(Op::RV_BNE, {.Rs1 = 13, .Rs2 = 0, .Imm = -20})};
  std::vector<std::string> Reports;
  for (const uint32_t Quantum : {7U, 100U, 1U << 16}) {
    Settings.Quantum = Quantum;
    auto M = Machine::create(Settings);
    ASSERT_TRUE(M);
    (*M)->load(codeImage(program(Body)));
    Reports.push_back(toJson(*(*M)->run().Time));
    EXPECT_EQ(Reports.back(), Reports.front()) << Quantum;
  }
}

TEST_F(ClockTest, KeysThatAreSaidToChangeNoCycleChangeNone) {
  // Something for every unit of a core, and for every level of memory.
  const Words Body = repeat(
      3, {lw(10, 0, 7), encode(Op::RV_SW, {.Rs1 = 8, .Rs2 = 10}), lw(11, 0, 8),
          encode(Op::RV_MUL, {.Rd = 11, .Rs1 = 6, .Rs2 = 11}),
          encode(Op::RV_DIV, {.Rd = 11, .Rs1 = 11, .Rs2 = 6}),
          encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 5, .Rs2 = 6}),
          encode(Op::RV_FDIV_S, {.Rd = 2, .Rs1 = 1, .Rs2 = 6}),
          encode(Op::RV_FADD_S, {.Rd = 3, .Rs1 = 2, .Rs2 = 1}),
          encode(Op::RV_SW, {.Rs1 = 7, .Rs2 = 11})});
  unsigned Said = 0;
  for (const uint32_t FixedCycles : {0U, 5U}) {
    Config Base = timed();
    Base.Timing.L2.FixedCycles = FixedCycles;
    Settings = Base;
    const uint64_t Cycles = run(Body).Cycles;
    for (const TimingParam &P : timingParams())
      for (const uint32_t Value : {P.Low, P.High}) {
        const std::string List =
            fmt::format("timing.{}.{}={}", P.Group, P.Name, Value);
        Settings = Base;
        if (P.WordOf || !setValues(Settings, List))
          continue;
        const auto Notes = idleSettings(Base, Settings, List);
        if (Notes.empty())
          continue;
        EXPECT_EQ(run(Body).Cycles, Cycles) << Notes.front();
        ++Said;
      }
  }
  EXPECT_GT(Said, 40U);
}

} // namespace
