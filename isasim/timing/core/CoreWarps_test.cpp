/// The clock of cores with several warps.
#include "testing/TimedPrograms.h"
#include "timing/core/CoreClock.h"

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

class CoreWarpsTest : public ClockTest {
protected:
  /// Cycles that \p Count repetitions of \p Body take on each of \p Warps.
  uint64_t costOnAll(unsigned Warps, unsigned Count, const Words &Body) {
    Settings.WarpsPerCore = Warps;
    return runWhole(onAllWarps(repeat(Count, Body))).Cycles -
           runWhole(onAllWarps({})).Cycles;
  }
  void preset(CorePreset P) { Settings.Timing.Core = numbersOf(P); }
  static Words four(Op O) {
    Words All;
    for (unsigned Rd = 20; Rd != 24; ++Rd)
      All.push_back(encode(O, {.Rd = Rd, .Rs1 = 6, .Rs2 = 7}));
    return All;
  }

  static constexpr unsigned N = 50;
};

TEST_F(CoreWarpsTest, AWarpsPaceStaysUntilAUnitIsFull) {
  preset(CorePreset::Vortex2025);
  for (const unsigned Warps : {1U, 2U, 4U}) {
    EXPECT_NEAR(double(costOnAll(Warps, N, four(Op::RV_ADD))), 4.0 * N * 6, 10)
        << Warps;
    // Two in flight, 6 cycles each.
    const double Fp = std::max(6.0, 3.0 * Warps);
    EXPECT_NEAR(double(costOnAll(Warps, N, four(Op::RV_FADD_S))), 4.0 * N * Fp,
                0.03 * 4 * N * Fp)
        << Warps;
    EXPECT_NEAR(double(costOnAll(Warps, N, four(Op::RV_DIV))),
                4.0 * N * 34 * Warps, 0.03 * 4 * N * 34 * Warps)
        << Warps;
    // Two loads in flight, 11 cycles each in local memory.
    const double Load = std::max(6.0, 5.5 * Warps);
    const Words Loads = {lw(20, 0, 8), lw(21, 0, 8), lw(22, 0, 8),
                         lw(23, 0, 8)};
    EXPECT_NEAR(double(costOnAll(Warps, N, Loads)), 4.0 * N * Load,
                0.03 * 4 * N * Load)
        << Warps;
  }
}

TEST_F(CoreWarpsTest, OneInstructionACycleIsIssued) {
  // Dependent additions fill the core with as many warps as their latency.
  const Words Chain = {encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 1, .Rs2 = 2})};
  for (const unsigned Warps : {1U, 2U, 4U, 8U})
    EXPECT_NEAR(double(costOnAll(Warps, N, Chain)), N * std::max(4U, Warps), 8)
        << Warps;
}

// A warp's turn comes every Warps cycles, so that its wait is rounded up. The
// RTL of May 2023 takes 9, 10 and 12 cycles (docs/validation.md).
TEST_F(CoreWarpsTest, IssueSlotsGoInTurnToWarpsThatWait) {
  preset(CorePreset::Vortex5Stage);
  const Words Chain = {encode(Op::RV_FADD_S, {.Rd = 1, .Rs1 = 1, .Rs2 = 2})};
  for (const auto &[Warps, Each] : {std::pair(1U, 9), {2U, 10}, {4U, 12}})
    EXPECT_NEAR(double(costOnAll(Warps, N, Chain)), N * Each, 12) << Warps;
}

TEST_F(CoreWarpsTest, EachWarpBringsPlacesForItsLoads) {
  preset(CorePreset::Vortex5Stage);
  Settings.Timing.Core.LocalLatency = 8;
  const Words Loads = {lw(20, 0, 8), lw(21, 0, 8), lw(22, 0, 8), lw(23, 0, 8)};
  EXPECT_NEAR(double(costOnAll(4, N, Loads)), 4.0 * N * 5, 20);
  // Without them four places serve all warps, 8 cycles each.
  Settings.Timing.Core.LsuQueuePerWarp = 0;
  EXPECT_NEAR(double(costOnAll(4, N, Loads)), 4 * 4.0 * N * 8 / 4, 40);
}

// Accesses that wait for a place have issued: what is behind them goes on.
TEST_F(CoreWarpsTest, AccessesWaitInFrontOfTheirUnit) {
  preset(CorePreset::Vortex5Stage);
  Settings.Timing.Core.DcacheKib = 16;
  Settings.Timing.L2.FixedCycles = 300;
  // Five loads of other lines, of which four have places, then additions that
  // take as long as two of them.
  Words Body;
  for (int32_t Load = 0; Load != 5; ++Load)
    Body = Body + Words{lw(20 + static_cast<unsigned>(Load), Load * 128, 7)};
  Body = Body + repeat(120, {addi(12, 6, 0)});
  EXPECT_NEAR(double(cost(1, Body)), 125 * 5, 30);
  Settings.Timing.Core.LsuFront = 0;
  EXPECT_NEAR(double(cost(1, Body)), 125 * 5 + 300, 50);
}

// The port is busy until 10. What a bank accepts right behind two stores goes
// on, because it does not see them in its queue yet.
TEST(DataCacheBanksTest, ABankSeesItsQueueThreeCyclesLater) {
  DataCacheBanks Banks(2, 2, 2, false);
  Banks.clear();
  for (unsigned N = 0; N != 10; ++N)
    Banks.send(TimingLineBytes, 0);
  for (const uint64_t N : {0, 1}) {
    EXPECT_EQ(Banks.accept(0, N), N);
    EXPECT_EQ(Banks.send(0, N), 10 + N);
  }
  EXPECT_EQ(Banks.accept(0, 2), 2U);
  EXPECT_EQ(Banks.accept(0, 3), 3U);
  EXPECT_EQ(Banks.accept(0, 4), 10 + 4U);
}

// 16 words of a bank, of both warps in turn by lane: both loads have their last
// word after 32 cycles and not the first one's after 16. The RTL of May 2023
// takes 25 and 40 cycles a load.
TEST_F(CoreWarpsTest, LowerLanesOfALaterAccessGoFirst) {
  preset(CorePreset::Vortex5Stage);
  const Words OneBank = {csrr(9, CSR_THREAD_ID),
                         encode(Op::RV_SLLI, {.Rd = 9, .Rs1 = 9, .Imm = 6}),
                         lui(8, 0xffff0000),
                         encode(Op::RV_ADD, {.Rd = 8, .Rs1 = 8, .Rs2 = 9}),
                         encode(Op::RV_SW, {.Rs1 = 8, .Rs2 = 8})};
  const auto EachLoad = [&](unsigned Warps, const Words &Load) {
    Settings.WarpsPerCore = Warps;
    const auto Cycles = [&](unsigned Loads) {
      return runWhole(onAllWarps(OneBank + repeat(Loads, Load))).Cycles;
    };
    return double(Cycles(2 * N) - Cycles(N)) / N;
  };
  const Words Chained = {lw(8, 0, 8)};
  EXPECT_NEAR(EachLoad(1, Chained), 25, 0.5);
  EXPECT_NEAR(EachLoad(2, Chained), 40, 1);
  // A bank gives a word a cycle all the same.
  const Words Four = {lw(10, 0, 8), lw(11, 0, 8), lw(12, 0, 8), lw(13, 0, 8)};
  EXPECT_NEAR(EachLoad(1, Four), 4 * 16, 0.5);
  EXPECT_NEAR(EachLoad(2, Four), 4 * 32, 0.5);
  Settings.Timing.Core.LaneBuffers = 0;
  EXPECT_NEAR(EachLoad(2, Chained), 32, 1);
}

TEST_F(CoreWarpsTest, AFullBufferKeepsTheDecoderFromOtherWarps) {
  preset(CorePreset::Vortex5Stage);
  Settings.WarpsPerCore = 2;
  constexpr unsigned Adds = 400, Rounds = 20;
  const auto Cycles = [&](unsigned Divisions) {
    // Warp 0 adds. The other one divides, and waits with a full buffer.
    const Words Other =
        repeat(Divisions, {encode(Op::RV_DIV, {.Rd = 11, .Rs1 = 11, .Rs2 = 7}),
                           addi(12, 11, 0), addi(13, 6, 0), addi(14, 6, 0)});
    const Words First = repeat(Adds, {addi(12, 6, 0)});
    return runWhole(
               onAllWarps(
                   Words{csrr(10, CSR_WARP_ID),
                         encode(Op::RV_BNE,
                                {.Rs1 = 10,
                                 .Rs2 = 0,
                                 .Imm = int32_t(4 * (First.size() + 2))})} +
                   First +
                   Words{encode(
                       Op::RV_JAL,
                       {.Rd = 0, .Imm = int32_t(4 * (Other.size() + 1))})} +
                   Other))
        .Cycles;
  };
  const uint64_t Alone = Cycles(0);
  EXPECT_NEAR(double(Alone), Adds * 5.0, 100);
  // From the third addition's fetch, 15 cycles behind the division, to the
  // division's end.
  EXPECT_NEAR(double(Cycles(Rounds) - Alone), Rounds * (38 - 15), Rounds * 6);
  Settings.Timing.Core.DecodeBlocks = 0;
  EXPECT_NEAR(double(Cycles(Rounds)), double(Alone), Rounds * 4);
}

/// Warp n spins 100 n times, then all four meet at a barrier.
Words meeting() {
  return {csrr(10, CSR_WARP_ID),
          addi(11, 0, 100),
          encode(Op::RV_MUL, {.Rd = 10, .Rs1 = 10, .Rs2 = 11}),
          addi(10, 10, 1),
          addi(10, 10, -1), // loop
          encode(Op::RV_BNE, {.Rs1 = 10, .Rs2 = 0, .Imm = -4}),
          addi(12, 0, 3),
          addi(13, 0, 4),
          encode(Op::VX_BAR, {.Rs1 = 12, .Rs2 = 13})};
}

TEST_F(CoreWarpsTest, ABarrierWaitsForTheLastWarp) {
  Settings.WarpsPerCore = 4;
  preset(CorePreset::Vortex2025);
  // The last spins 301 times, an addition and a branch each.
  const Words Adds = repeat(5, four(Op::RV_ADD));
  const uint64_t Meeting = runWhole(onAllWarps(meeting())).Cycles;
  EXPECT_NEAR(double(Meeting), 301.0 * (9 + 15), 200);
  // What comes behind it, comes behind it on all warps at once.
  EXPECT_NEAR(double(runWhole(onAllWarps(meeting() + Adds)).Cycles - Meeting),
              20.0 * 6, 10);
}

TEST_F(CoreWarpsTest, AWarpCanBeStartedAgain) {
  Settings.WarpsPerCore = 2;
  Settings.Quantum = 8; // so that it has ended by then
  preset(CorePreset::Vortex5Stage);
  // The other's wait for its load would hold up warp 0.
  Settings.Timing.Core.DecodeBlocks = 0;
  // Warp 0 starts the other twice, which counts in memory and ends.
  const auto Program = [](unsigned Times) {
    const Words Wait = {addi(21, 0, 20), addi(21, 21, -1),
                        encode(Op::RV_BNE, {.Rs1 = 21, .Rs2 = 0, .Imm = -4})};
    Words Start;
    for (unsigned T = 0; T != Times; ++T)
      Start =
          Start + Words{encode(Op::VX_WSPAWN, {.Rs1 = 9, .Rs2 = 10})} + Wait;
    // Over the other one's code.
    const Words Head = {csrr(9, CSR_NUM_WARPS),
                        encode(Op::RV_AUIPC, {.Rd = 10}), addi(10, 10, 12),
                        encode(Op::RV_JAL, {.Rd = 0, .Imm = 6 * 4})};
    const Words Other = {lui(7, 0x100000), lw(11, 0, 7), addi(11, 11, 1),
                         sw(11, 0, 7)};
    return Head + Other + Words{encode(Op::VX_TMC, {.Rs1 = 0})} + Start +
           Words{encode(Op::VX_TMC, {.Rs1 = 0})};
  };
  const uint64_t None = runWhole(Program(0)).Cycles;
  for (const unsigned Times : {1U, 2U, 3U}) {
    const TimeReport R = runWhole(Program(Times));
    EXPECT_EQ(activity(R, "core warp instructions", "store"), Times);
    // A split's time for each start, and the loop.
    EXPECT_NEAR(double(R.Cycles - None), Times * (8 + 5 + 20 * 13.0), 10)
        << Times;
  }
}

TEST_F(CoreWarpsTest, ReportsAreTheSameForAnyThreadsAndQuantum) {
  Settings = timed(4);
  Settings.SocketsPerCluster = 2;
  Settings.WarpsPerCore = 4;
  const Words Body =
      meeting() +
      Words{csrr(12, CSR_MHARTID),
            encode(Op::RV_SH2ADD, {.Rd = 7, .Rs1 = 12, .Rs2 = 7}),
            addi(13, 0, 30),
            lw(10, 0, 7), // loop
            encode(Op::RV_MUL, {.Rd = 11, .Rs1 = 10, .Rs2 = 12}),
            sw(11, 1024, 7),
            sw(11, 0, 8),
            lw(14, 0, 8),
            addi(13, 13, -1),
            encode(Op::RV_BNE, {.Rs1 = 13, .Rs2 = 0, .Imm = -6 * 4})};
  for (const CorePreset P : {CorePreset::Forwarding, CorePreset::Vortex5Stage,
                             CorePreset::Vortex2025}) {
    preset(P);
    std::string First;
    for (const unsigned Threads : {1U, 2U, 8U})
      for (const uint32_t Quantum : {7U, 100U, 1U << 16}) {
        Settings.HostThreads = Threads;
        Settings.Quantum = Quantum;
        const std::string Report = toJson(runWhole(onAllWarps(Body)));
        if (First.empty())
          First = Report;
        EXPECT_EQ(Report, First) << Threads << ' ' << Quantum;
      }
  }
}

// Warps that wait for other cores, or for the rasterizer, while theirs goes on.
TEST_F(CoreWarpsTest, WarpsWaitOutsideTheirCore) {
  Settings = timed(2);
  Settings.WarpsPerCore = 2;
  // All four warps of the device meet; then each waits for the rasterizer.
  const Words Body =
      Words{csrr(10, CSR_CORE_ID), csrr(14, CSR_WARP_ID),
            encode(Op::RV_SH1ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 14})} +
      countThenMeet(4) + Words{csrr(15, raster::Csr::Wait)};
  std::string First;
  for (const unsigned Threads : {1U, 4U}) {
    Settings.HostThreads = Threads;
    const TimeReport R = runWhole(onAllWarps(Body));
    if (First.empty())
      First = toJson(R);
    EXPECT_EQ(toJson(R), First);
    // The last one spins 301 times beside another warp of its core.
    EXPECT_NEAR(double(R.Cycles),
                301.0 * (2 + Settings.Timing.Core.BranchPenalty), 400);
    EXPECT_EQ(R.OutOfOrder, 0U);
  }
}

} // namespace
