/// Code that has to be fetched, against runs of which every fetch hits.
#include "timing/core/InstructionCache.h"

#include "testing/TimedPrograms.h"

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

constexpr uint32_t WordsOfLine = TimingLineBytes / 4;

Words additions(unsigned Count) { return repeat(Count, {addi(10, 10, 1)}); }

/// \p Rounds times \p Body.
Words loop(int32_t Rounds, const Words &Body) {
  const auto Back = -4 * static_cast<int32_t>(Body.size() + 1);
  return Words{addi(11, 0, Rounds)} + Body +
         Words{addi(11, 11, -1),
               encode(Op::RV_BEQ, {.Rs1 = 11, .Rs2 = 0, .Imm = 8}),
               encode(Op::RV_JAL, {.Rd = 0, .Imm = Back - 4})};
}

class CodeTest : public ClockTest {
protected:
  uint64_t misses(const TimeReport &R) {
    return activity(R, "instruction cache", "misses");
  }
  /// The run with an instruction cache of so many KiB.
  TimeReport with(uint32_t Kib, const Words &Body) {
    Settings.Timing.Socket.IcacheKib = Kib;
    TimeReport R = run(Body);
    Settings.Timing.Socket.IcacheKib = 0;
    return R;
  }
};

TEST_F(CodeTest, EveryLineMissesOnceAndEveryMissIsWaitedFor) {
  for (const CorePreset Preset :
       {CorePreset::Forwarding, CorePreset::Vortex5Stage}) {
    Settings.Timing.Core = numbersOf(Preset);
    const Words Body = loop(20, additions(10 * WordsOfLine));
    const TimeReport Ideal = run(Body), R = with(16, Body);
    const auto Lines = (program(Body).size() + WordsOfLine - 1) / WordsOfLine;
    EXPECT_NEAR(static_cast<double>(misses(R)), static_cast<double>(Lines), 1);
    // Nothing but fetches takes longer.
    EXPECT_EQ(R.Cycles - Ideal.Cycles,
              of(R, CoreCycle::Fetch) - of(Ideal, CoreCycle::Fetch));
    const uint64_t Longest = 200; // of a miss
    EXPECT_GT(R.Cycles, Ideal.Cycles + misses(R) * 20);
    EXPECT_LT(R.Cycles, Ideal.Cycles + misses(R) * Longest);
  }
}

TEST_F(CodeTest, CodeWaitsForTheLink) {
  const Words Body = additions(10 * WordsOfLine);
  const TimeReport None = with(16, Body);
  Settings.Timing.Link = {.ToL2Ns = 100, .FromL2Ns = 40};
  const TimeReport R = with(16, Body);
  const auto Cycles = static_cast<double>(misses(R)) * 140 * R.ClockMhz / 1000;
  EXPECT_NEAR(static_cast<double>(of(R, CoreCycle::Link)), Cycles,
              3.0 * static_cast<double>(misses(R)));
  EXPECT_NEAR(static_cast<double>(of(R, CoreCycle::Fetch)),
              static_cast<double>(of(None, CoreCycle::Fetch)),
              3.0 * static_cast<double>(misses(R)));
}

TEST_F(CodeTest, ALoopThatDoesNotFitMissesInEveryRound) {
  Settings.Timing.Socket.IcacheWays = 1;
  // 1 KiB has 16 lines. Of a loop of 17, 2 share a place.
  constexpr int32_t Rounds = 10;
  const uint64_t Fits =
      misses(with(1, loop(Rounds, additions(14 * WordsOfLine - 16))));
  EXPECT_LE(Fits, 16U);
  const TimeReport R = with(1, loop(Rounds, additions(18 * WordsOfLine - 16)));
  EXPECT_GE(misses(R), 16U + 4 * (Rounds - 1));
  EXPECT_LE(misses(R), 20U + 6 * (Rounds - 1));
  // With the least recently used of all ways replaced, all of them miss.
  Settings.Timing.Socket.IcacheWays = 16;
  EXPECT_GE(misses(with(1, loop(Rounds, additions(18 * WordsOfLine - 16)))),
            17U * Rounds);
}

TEST_F(CodeTest, CoresOfASocketShareIt) {
  const Words Body = additions(20 * WordsOfLine);
  const uint64_t OfOne = misses(with(16, Body));
  Settings.CoresPerSocket = 4;
  EXPECT_EQ(misses(with(16, Body)), OfOne);
  Settings.SocketsPerCluster = 2;
  EXPECT_EQ(misses(with(16, Body)), 2 * OfOne);
}

TEST_F(CodeTest, TheReportDependsOnTheProgramAlone) {
  // Cores and warps that take different ways through more code than fits.
  const Words Body = Words{csrr(10, CSR_CORE_ID)} + countThenMeet(16) +
                     loop(3, Words{lw(12, 0, 7)} + additions(30 * WordsOfLine) +
                                 Words{sw(10, 0, 7)});
  Settings = timed(4);
  Settings.SocketsPerCluster = 2;
  Settings.WarpsPerCore = 2;
  Settings.Timing.Core = numbersOf(CorePreset::Vortex5Stage);
  Settings.Timing.Socket.IcacheKib = 1;
  Settings.Timing.Core.DcacheKib = 1;
  Settings.Timing.Link.ToL2Ns = 20;
  const std::string Expected = toJson(runWhole(onAllWarps(Body)));
  for (const unsigned Threads : {1U, 4U})
    for (const uint32_t Quantum : {1U << 16, 50U, 7U}) {
      Settings.HostThreads = Threads;
      Settings.Quantum = Quantum;
      EXPECT_EQ(toJson(runWhole(onAllWarps(Body))), Expected)
          << Threads << " threads, quantum " << Quantum;
    }
}

} // namespace
