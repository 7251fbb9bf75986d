/// Commands of the host, against closed formulas.
#include "testing/TimedPrograms.h"
#include "timing/host/HostUnits.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint64_t Line = TimingLineBytes;

class HostUnitsTest : public ClockTest {
protected:
  HostUnitsTest() {
    Settings.Timing.ClockMhz = 1000; // a cycle is a ns
    HostTiming &H = Settings.Timing.Host;
    H.DmaEngines = 2;
    H.OneWayNs = 300;
    H.DecodeNs = 100;
    H.LinkMbps = 3200; // 20 ns a line
    H.DmaBytes = 32;   // two cycles a line
    // Memory that takes a line a cycle, and answers 50 cycles later.
    Settings.Timing.L2.FixedCycles = 50;
  }

  struct Sent {
    HostCopy What;
    CommandOrder Order;
  };
  /// When each of some copies ends, without cores.
  std::vector<uint64_t> endsOf(const std::vector<Sent> &All) {
    HostUnits Units(Settings.Timing);
    MemorySystem Memory(Settings.Timing, 1);
    Units.begin(0);
    for (const Sent &S : All)
      Units.sendCopy(S.What, S.Order);
    std::vector<Answer> Answers;
    while (!Units.isIdle()) {
      if (Memory.nextEvent() <= Units.turn().At) {
        Answers.clear();
        Memory.advance(Units.turn().At == Turn::Never ? Memory.nextEvent()
                                                      : Units.turn().At,
                       Answers);
        for (const Answer &A : Answers)
          Units.answer(A);
      } else {
        Units.step(Memory);
      }
    }
    std::vector<uint64_t> Ends;
    for (uint64_t N = 1; N <= All.size(); ++N)
      Ends.push_back(*Units.endOf(N));
    Units.end(Units.present());
    Engines = Units.engines();
    for (const DmaTime &T : Engines)
      EXPECT_EQ(std::reduce(T.Cycles.begin(), T.Cycles.end()), Units.present())
          << "every cycle has one reason";
    return Ends;
  }
  static HostCopy to(uint64_t Lines, uint32_t Address = 0x100000) {
    return {HostCopy::Kind::ToDevice, Address, 0, Lines * Line};
  }
  static HostCopy from(uint64_t Lines, uint32_t Address = 0x100000) {
    return {HostCopy::Kind::FromDevice, Address, 0, Lines * Line};
  }
  uint64_t linesBegun() const {
    uint64_t Sum = 0;
    for (const DmaTime &T : Engines)
      Sum += T.Lines;
    return Sum;
  }

  /// Doorbell, fetch and decoding of a command that the host sends at 0.
  static constexpr uint64_t Decoded = 3 * 300 + 100;
  std::vector<DmaTime> Engines;
};

TEST_F(HostUnitsTest, ACopyTakesItsBytesOnTheHostsLink) {
  for (const uint64_t N : {1U, 2U, 100U, 1000U}) {
    // The first line is asked for, and all come one behind the other.
    EXPECT_EQ(endsOf({{to(N), {}}})[0], Decoded + 2 * 300 + 20 * N) << N;
    // Lines are read from memory while others leave.
    EXPECT_EQ(endsOf({{from(N), {}}})[0], Decoded + 50 + 20 * N + 300) << N;
    EXPECT_EQ(linesBegun(), N);
  }
  EXPECT_EQ(endsOf({{to(0), {}}})[0], Decoded);
}

TEST_F(HostUnitsTest, LinesInFlightBoundACopy) {
  Settings.Timing.Host.DmaRequests = 4;
  // Round trips of four lines; the link carries a line in 20 ns.
  const uint64_t Round = 2 * 300 + 20;
  EXPECT_EQ(endsOf({{to(40), {}}})[0], Decoded + 10 * Round + 3 * 20);
}

TEST_F(HostUnitsTest, ACopyOnTheDeviceIsAsFastAsItsEngine) {
  const HostCopy Within{HostCopy::Kind::OnDevice, 0x200000, 0x100000,
                        1000 * Line};
  // Two cycles a line; a line is there 50 cycles later. It then waits a cycle
  // for memory, which has taken another engine's read.
  EXPECT_NEAR(static_cast<double>(endsOf({{Within, {}}})[0]),
              Decoded + 2 * 1000 + 50, 4);
  const HostCopy Fill{HostCopy::Kind::Fill, 0x200000, 0, 1000 * Line};
  EXPECT_NEAR(static_cast<double>(endsOf({{Fill, {}}})[0]), Decoded + 2 * 1000,
              4);
}

TEST_F(HostUnitsTest, CopiesOverlap) {
  constexpr uint64_t N = 500;
  const uint64_t Second = Decoded + 100; // is decoded behind the first
  // Each way has its own link.
  std::vector<uint64_t> Ends = endsOf({{to(N), {}}, {from(N, 0x200000), {}}});
  EXPECT_EQ(Ends[0], Decoded + 600 + 20 * N);
  EXPECT_NEAR(static_cast<double>(Ends[1]), Second + 50 + 20 * N + 300, 2);
  // Two that go the same way share it: they end together.
  Ends = endsOf({{to(N), {}}, {to(N, 0x200000), {}}});
  EXPECT_NEAR(static_cast<double>(Ends[1]), Decoded + 600 + 20 * 2 * N, 20);
  // The first is ahead by the lines in flight that it began alone.
  EXPECT_LE(Ends[1] - Ends[0], 20 * 64U);
  // One engine does one after the other, and begins the second when the first
  // has ended.
  Settings.Timing.Host.DmaEngines = 1;
  Ends = endsOf({{to(N), {}}, {to(N, 0x200000), {}}});
  EXPECT_EQ(Ends[0], Decoded + 600 + 20 * N);
  EXPECT_EQ(Ends[1], Ends[0] + 600 + 20 * N);
}

TEST_F(HostUnitsTest, AnOrderKeepsCopiesApart) {
  constexpr uint64_t N = 100;
  const uint64_t First = Decoded + 50 + 20 * N + 300;
  // Behind an event: the command was decoded long ago.
  EXPECT_EQ(endsOf({{from(N), {}}, {from(N), {{1}, {}}}})[1],
            First + 50 + 20 * N + 300);
  // Behind a wait of the host, which then sends it.
  EXPECT_EQ(endsOf({{from(N), {}}, {from(N), {{}, {1}}}})[1],
            First + Decoded + 50 + 20 * N + 300);
}

TEST_F(HostUnitsTest, AFullQueueFetchesNothing) {
  Settings.Timing.Host.QueueEntries = 1;
  const std::vector<uint64_t> Ends = endsOf({{to(10), {}}, {to(10), {}}});
  // The second is fetched when the first has ended; its doorbell was rung.
  EXPECT_EQ(Ends[1], Ends[0] + 600 + 100 + 600 + 20 * 10);
}

TEST_F(HostUnitsTest, PartsOfLinesAreWritten) {
  const HostCopy Odd{HostCopy::Kind::ToDevice, 0x100020, 0, 2 * Line};
  endsOf({{Odd, {}}});
  EXPECT_EQ(linesBegun(), 3U);
}

/// A run of some hundred instructions, behind copies.
class HostRunTest : public HostUnitsTest {
protected:
  HostRunTest() { Settings.Timing.L2.FixedCycles = 0; }

  std::unique_ptr<Machine> machine(const Words &Code) {
    auto M = Machine::create(Settings);
    EXPECT_TRUE(M) << M.error().What;
    (*M)->load(codeImage(program(Code)));
    return std::move(*M);
  }
  static TimeReport runOn(Machine &M) {
    const RunResult R = M.run();
    EXPECT_EQ(R.End, Outcome::Done) << R.Report;
    const auto Whole = [&](const auto &Units) {
      for (const auto &T : Units)
        EXPECT_EQ(std::reduce(T.Cycles.begin(), T.Cycles.end()),
                  R.Time->Cycles);
    };
    Whole(R.Time->Cores);
    Whole(R.Time->Rasters);
    Whole(R.Time->PixelUnits);
    Whole(R.Time->CommandProcessors);
    Whole(R.Time->DmaEngines);
    return *R.Time;
  }
  static uint64_t waited(const TimeReport &R) {
    return of(R, CoreCycle::Launch);
  }
  const Words Body = repeat(300, {addi(10, 10, 1)});
  const Words Loads = repeat(300, {lw(10, 0, 7), addi(7, 7, 64)});
};

TEST_F(HostRunTest, ALaunchWaitsForItsCommand) {
  const auto M = machine(Body);
  EXPECT_EQ(waited(runOn(*M)), Decoded);
  // The host had sent the next one long ago.
  EXPECT_EQ(waited(runOn(*M)), 0U);
  EXPECT_EQ(waited(runOn(*M)), 0U);
  // Now it looks at a result first.
  const uint64_t Read = M->copies(from(1, VX_GLOBAL_BASE), {{3}, {}});
  M->orderLaunch({{}, {Read}});
  EXPECT_GT(waited(runOn(*M)), 300 + Decoded);
}

TEST_F(HostRunTest, WithoutUnitsNothingWaits) {
  Settings.Timing.Host.DmaEngines = 0;
  const auto M = machine(Body);
  EXPECT_EQ(M->copies(to(100, VX_GLOBAL_BASE), {}), 0U);
  const TimeReport R = *M->run().Time;
  EXPECT_EQ(waited(R), 0U);
  EXPECT_TRUE(R.DmaEngines.empty());
  EXPECT_TRUE(R.CommandProcessors.empty());
}

TEST_F(HostRunTest, ACopyRunsBesideAKernel) {
  Settings.Timing.L2.Kib = Settings.Timing.Llc.Kib = 8;
  const auto M = machine(Loads);
  const TimeReport First = runOn(*M);
  const uint64_t Alone = runOn(*M).Cycles;
  constexpr uint64_t N = 300;
  const uint64_t Busy = 2 * 300 + 20 * N;
  ASSERT_GT(Alone, Busy);
  // Nobody waits for the copy, which takes memory's time.
  const uint64_t Copy = M->copies(to(N, VX_GLOBAL_BASE), {{2}, {}});
  M->orderLaunch({{2}, {}});
  const TimeReport Beside = runOn(*M);
  EXPECT_EQ(waited(Beside), 0U);
  EXPECT_GT(Beside.Cycles, Alone);
  EXPECT_LT(Beside.Cycles, Alone + Busy);
  EXPECT_EQ(Beside.DmaEngines[0].Lines, N);
  EXPECT_EQ(Beside.DmaEngines[0].Bytes, N * Line);
  EXPECT_GT(Beside.Dram.WriteBursts, First.Dram.WriteBursts);
  // The next launch waits for the copy before it.
  const uint64_t Second = M->copies(to(N, VX_GLOBAL_BASE), {{Copy}, {}});
  M->orderLaunch({{Second}, {}});
  const TimeReport Behind = runOn(*M);
  EXPECT_NEAR(static_cast<double>(waited(Behind)), Busy, 50);
}

TEST_F(HostRunTest, TimeThatTheHostWaitsIsOfNoRun) {
  const auto M = machine(Body);
  const uint64_t Alone = runOn(*M).Cycles - Decoded;
  M->copies(to(10000, VX_GLOBAL_BASE), {});
  M->settle();
  const TimeReport R = runOn(*M);
  EXPECT_EQ(waited(R), 0U);
  EXPECT_EQ(R.DmaEngines[0].Lines, 0U);
  EXPECT_EQ(R.Cycles, Alone);
}

TEST_F(HostRunTest, HostThreadsDoNotMatter) {
  std::vector<std::string> Reports;
  Settings = timed(4);
  Settings.Timing.Host.DmaEngines = 2;
  for (const unsigned Threads : {1U, 2U, 8U}) {
    Settings.HostThreads = Threads;
    const auto M = machine(Loads);
    std::string Text;
    for (int Run = 0; Run != 3; ++Run) {
      M->copies(to(500, VX_GLOBAL_BASE), {});
      M->copies(from(500, VX_GLOBAL_BASE + 0x10000), {{1}, {}});
      M->orderLaunch({});
      Text += toJson(runOn(*M));
    }
    Reports.push_back(Text);
    EXPECT_EQ(Reports.back(), Reports.front()) << Threads;
  }
}

} // namespace
