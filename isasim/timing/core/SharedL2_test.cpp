/// Several cores with data caches on an L2 behind a crossbar, by formulas that
/// the RTL's text gives (docs/validation.md#several-cores).
#include "testing/TimedPrograms.h"

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

class SharedL2 : public ClockTest {
protected:
  void cores(unsigned Count) {
    Settings = timed(Count);
    TimingConfig &T = Settings.Timing;
    T.Core = numbersOf(CorePreset::Vortex5Stage);
    T.Core.DcacheKib = 16;
    T.L2.Ways = 1;
    T.L2.HitCycles = 12;
    T.L2.Crossbar = T.L2.WriteThrough = 1;
    T.Llc.ConstantCycles = 51;
  }
  /// x9: a line for each lane, other lines for each core.
  static Words lanesLines() {
    return {lui(9, 0x100000),
            encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 6}),
            encode(Op::RV_ADD, {.Rd = 9, .Rs1 = 9, .Rs2 = 10}),
            csrr(11, CSR_CORE_ID),
            encode(Op::RV_SLLI, {.Rd = 11, .Rs1 = 11, .Imm = 12}),
            encode(Op::RV_ADD, {.Rd = 9, .Rs1 = 9, .Rs2 = 11})};
  }
  static constexpr unsigned N = 60;
};

// The port to memory takes a line a cycle, whoever writes.
TEST_F(SharedL2, StoresOfAllCoresLeaveALineACycle) {
  for (const unsigned Count : {1U, 2U, 4U}) {
    cores(Count);
    EXPECT_NEAR(double(cost(N, {sw(6, 0, 9)}, lanesLines())), 16.0 * Count * N,
                60)
        << Count;
  }
}

TEST_F(SharedL2, ALineOnItsWayIsAskedForOnce) {
  cores(1);
  const Words Loads = {lw(20, 0, 9), lw(21, 4, 9), lw(22, 8, 9)};
  const TimeReport R = run(lanesLines() + Loads);
  EXPECT_EQ(R.L2.front().Reads, 16U);
  // The others come a cycle later each, and are issued later.
  EXPECT_LT(R.Cycles, run(lanesLines() + Words{lw(20, 0, 9)}).Cycles + 20);
}

// Misses of several cores in one line are one request to memory.
TEST_F(SharedL2, CoresShareWhatComesFromMemory) {
  cores(4);
  const Words Same = {lui(9, 0x100000),
                      encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 6}),
                      encode(Op::RV_ADD, {.Rd = 9, .Rs1 = 9, .Rs2 = 10})};
  const TimeReport R = run(Same + Words{lw(20, 0, 9)});
  EXPECT_EQ(R.L2.front().Reads, 4U * 16);
  EXPECT_EQ(R.L2.front().Merged + R.L2.front().Hits, 3U * 16);
}

// Nobody knows when places get free, and what is behind the accesses that wait
// for one goes on all the same.
TEST_F(SharedL2, AccessesWaitInFrontForWhatIsNotKnown) {
  cores(1);
  Settings.Timing.Llc.ConstantCycles = 300;
  Words Body;
  for (int32_t Load = 0; Load != 7; ++Load)
    Body = Body + Words{lw(20 + static_cast<unsigned>(Load), Load * 64, 7)};
  const auto Cycles = [&](unsigned Adds) {
    return double(run(Body + repeat(Adds, {addi(12, 6, 0)})).Cycles);
  };
  // Four are answered first, then three more, which end the run.
  const double Few = Cycles(0);
  EXPECT_GT(Few, 600);
  EXPECT_NEAR(Cycles(80), Few, 10);
  Settings.Timing.Core.LsuFront = 0;
  EXPECT_GT(Cycles(80), Few + 60);
}

// With two warps a core, which wait for its port in turn.
TEST_F(SharedL2, ThreadsOfTheHostDoNotMatter) {
  const auto Cycles = [&](unsigned Threads) {
    cores(4);
    Settings.WarpsPerCore = 2;
    Settings.HostThreads = Threads;
    return runWhole(onAllWarps(lanesLines() +
                               repeat(N, {sw(6, 0, 9), lw(20, 64, 9)})))
        .Cycles;
  };
  EXPECT_EQ(Cycles(1), Cycles(4));
}

} // namespace
