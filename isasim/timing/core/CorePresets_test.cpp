/// The named sets of numbers for a core, by formulas that their sources give.
#include "testing/TimedPrograms.h"

using namespace vorion;
using namespace vorion::isasim;
using namespace vorion::isasim::testing;

namespace {

/// What a preset says of one warp, in cycles.
struct Expected {
  CorePreset Preset;
  unsigned Fetch;     ///< between two independent instructions
  unsigned Add, Fma;  ///< from one to the next that needs its result
  unsigned Mul, Div;  ///< the same
  unsigned DivPace;   ///< between two divisions
  unsigned FdivPace2; ///< for two independent divisions of fp32
  unsigned Branch;    ///< from a branch to the next instruction
  unsigned Split, Join;
  unsigned Local;   ///< from a load of local memory to its use
  unsigned Lines16; ///< between two loads of 16 lines each
};

class CorePresetTest : public ClockTest,
                       public ::testing::WithParamInterface<Expected> {
protected:
  CorePresetTest() {
    Settings.Timing.Preset = GetParam().Preset;
    Settings.Timing.Core = numbersOf(GetParam().Preset);
  }
  /// Of a chain, whose last result is waited for by nobody.
  uint64_t chain(unsigned Count, unsigned Each) const {
    return std::max<uint64_t>(uint64_t{Count - 1} * Each + 1,
                              uint64_t{Count} * E.Fetch);
  }
  static Words op(Op O, unsigned Rd, unsigned Rs1, unsigned Rs2) {
    return {encode(O, {.Rd = Rd, .Rs1 = Rs1, .Rs2 = Rs2})};
  }

  static constexpr unsigned N = 100;
  const Expected &E = GetParam();
};

TEST_P(CorePresetTest, IndependentOperationsComeAtThePaceOfTheFetch) {
  const Words Adds = op(Op::RV_ADD, 10, 6, 7) + op(Op::RV_ADD, 11, 6, 7) +
                     op(Op::RV_ADD, 12, 6, 7) + op(Op::RV_ADD, 13, 6, 7);
  EXPECT_EQ(cost(N, Adds), 4U * N * E.Fetch);
  const Words Mixed = op(Op::RV_MUL, 10, 6, 7) + op(Op::RV_FADD_S, 1, 5, 6) +
                      op(Op::RV_ADD, 12, 6, 7) + Words{csrr(13, CSR_THREAD_ID)};
  EXPECT_EQ(cost(N, Mixed), 4U * N * E.Fetch);
}

TEST_P(CorePresetTest, AResultCanBeUsedBehindItsCommit) {
  EXPECT_EQ(cost(N, op(Op::RV_ADD, 10, 10, 7)), chain(N, E.Add));
  EXPECT_EQ(cost(N, op(Op::RV_MUL, 10, 10, 7)), chain(N, E.Mul));
  EXPECT_EQ(cost(N, op(Op::RV_FADD_S, 1, 1, 2)), chain(N, E.Fma));
}

TEST_P(CorePresetTest, TheDividerIsNotPipelined) {
  // What waits in front of it has issued.
  EXPECT_NEAR(double(cost(N, op(Op::RV_DIV, 10, 10, 7))), double(N) * E.Div,
              3.0 * E.Div);
  EXPECT_NEAR(
      double(cost(N, op(Op::RV_DIV, 10, 6, 7) + op(Op::RV_DIV, 11, 6, 7))),
      2.0 * N * E.DivPace, 3.0 * E.DivPace);
}

TEST_P(CorePresetTest, DivisionsOfFp32KeepTheirPlaces) {
  Words Sixteen;
  for (unsigned Rd = 16; Rd != 32; ++Rd)
    Sixteen = Sixteen + op(Op::RV_FDIV_S, Rd, 8, 9);
  EXPECT_NEAR(double(cost(N, Sixteen)), 8.0 * N * E.FdivPace2, 40);
}

TEST_P(CorePresetTest, NothingIsFetchedBehindABranch) {
  EXPECT_EQ(cost(N, {encode(Op::RV_BNE, {.Rs1 = 0, .Rs2 = 0, .Imm = 8})}),
            uint64_t{N} * E.Branch);
  const Words Loop = {addi(10, 0, 50), addi(10, 10, -1),
                      encode(Op::RV_BNE, {.Rs1 = 10, .Rs2 = 0, .Imm = -4})};
  const unsigned Taken =
      49 * Settings.Timing.Core.BranchPenalty; // where branches are guessed
  EXPECT_EQ(cost(1, Loop), E.Add + 50U * (E.Add + E.Branch) + Taken);
}

TEST_P(CorePresetTest, SplitsAndJoinsStopTheFetch) {
  const Words Uniform = {encode(Op::VX_SPLIT, {.Rd = 11, .Rs1 = 0}),
                         encode(Op::VX_JOIN, {.Rs1 = 11})};
  EXPECT_EQ(cost(N, Uniform), uint64_t{N} * (E.Split + E.Join));
  const Words Before = {encode(Op::RV_ANDI, {.Rd = 10, .Rs1 = 6, .Imm = 1}),
                        addi(12, 6, 0), addi(13, 6, 0)};
  // Into the split, to the other side, and together again.
  const Words Half = {encode(Op::VX_SPLIT, {.Rd = 11, .Rs1 = 10}),
                      encode(Op::VX_JOIN, {.Rs1 = 11})};
  const unsigned Masks = 3 * Settings.Timing.Core.MaskPenalty;
  EXPECT_EQ(cost(N, Half, Before),
            uint64_t{N} * (E.Split + 2 * E.Join + Masks));
}

TEST_P(CorePresetTest, LocalMemoryAnswersAtItsTime) {
  const Words OwnAddress = {sw(8, 0, 8)};
  EXPECT_EQ(cost(N, {lw(8, 0, 8)}, OwnAddress), chain(N, E.Local));
}

TEST_P(CorePresetTest, LinesOfAnAccessLeaveAtTheirPace) {
  const Words Before = {lui(7, 0x100000),
                        encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 6}),
                        encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 10}),
                        lw(11, 0, 7), encode(Op::RV_FENCE, {})};
  // All caches hold them, and as many as we like are in flight.
  Settings.Timing.Core.LsuQueue = 256;
  Words Loads;
  for (unsigned Rd = 12; Rd != 20; ++Rd)
    Loads.push_back(lw(Rd, 0, 7));
  EXPECT_NEAR(double(cost(N, Loads, Before)), 8.0 * N * E.Lines16,
              2.0 * E.Lines16);
}

INSTANTIATE_TEST_SUITE_P(
    CorePresets, CorePresetTest,
    ::testing::Values(Expected{.Preset = CorePreset::Forwarding,
                               .Fetch = 1,
                               .Add = 1,
                               .Fma = 4,
                               .Mul = 4,
                               .Div = 34,
                               .DivPace = 34,
                               .FdivPace2 = 2,
                               .Branch = 1,
                               .Split = 1,
                               .Join = 1,
                               .Local = 3,
                               .Lines16 = 16},
                      Expected{.Preset = CorePreset::Vortex5Stage,
                               .Fetch = 5,
                               .Add = 5,
                               .Fma = 9,
                               .Mul = 8,
                               .Div = 38,
                               .DivPace = 34,
                               .FdivPace2 = 10,
                               .Branch = 8,
                               .Split = 8,
                               .Join = 5,
                               .Local = 10,
                               .Lines16 = 5},
                      Expected{.Preset = CorePreset::Vortex2025,
                               .Fetch = 6,
                               .Add = 9,
                               .Fma = 12,
                               .Mul = 12,
                               .Div = 42,
                               .DivPace = 34,
                               .FdivPace2 = 17,
                               .Branch = 15,
                               .Split = 15,
                               .Join = 16,
                               .Local = 21,
                               .Lines16 = 32}),
    [](const auto &Info) {
      std::string Name(name(Info.param.Preset));
      std::erase(Name, '-');
      return Name;
    });

/// What the RTL of May 2023 does and no number says.
class FiveStagesTest : public ClockTest {
protected:
  FiveStagesTest() {
    Settings.Timing.Core = numbersOf(CorePreset::Vortex5Stage);
    Settings.Timing.Core.DcacheKib = 16;
  }
  static constexpr unsigned N = 100;
};

TEST_F(FiveStagesTest, TheDecoderDoesAJoin) {
  // The join waits in the buffer until the division is done, and the split
  // behind it in the decoder.
  const Words Body = {encode(Op::VX_SPLIT, {.Rd = 11, .Rs1 = 0}),
                      encode(Op::RV_DIV, {.Rd = 10, .Rs1 = 6, .Rs2 = 7}),
                      addi(10, 10, 0), encode(Op::VX_JOIN, {.Rs1 = 11})};
  EXPECT_EQ(cost(N, Body), N * (8U + 38 + 2));
}

TEST_F(FiveStagesTest, StoresWaitForTheCoresPort) {
  const Words Before = {lui(7, 0x100000),
                        encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 6}),
                        encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 10})};
  EXPECT_NEAR(double(cost(N, {sw(6, 0, 7)}, Before)), 16.0 * N, 40);
  // A load behind three stores waits until the first has left, one behind a
  // single store does not.
  const Words Load = {lw(12, 0, 7), addi(12, 12, 0)};
  const auto Round = [&](unsigned Stores) {
    return cost(
        N, repeat(Stores, {sw(6, 0, 7)}) + Load + repeat(20, {addi(13, 6, 0)}),
        Before);
  };
  const uint64_t One = Round(1), Three = Round(3);
  EXPECT_NEAR(double(Three - One), N * (2 * 5.0 + 16), N * 8.0);
}

// Release 2. The lines of a load follow one another in two cycles, and so do
// their fills, which go before the next load's lines: 16 of them take 32 cycles
// and the time in which a line comes. The RTL takes 86.
TEST_F(FiveStagesTest, LinesThatMissInRelease2WaitBehindFills) {
  Settings.Timing.Core = numbersOf(CorePreset::Vortex2025);
  Settings.Timing.Core.DcacheKib = 16;
  Settings.Timing.L2.FixedCycles = 61;
  const Words Before = {lui(7, 0x100000), lui(8, 0x1000),
                        encode(Op::RV_SLLI, {.Rd = 10, .Rs1 = 6, .Imm = 6}),
                        encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 10})};
  Words Loads;
  for (unsigned Rd = 12; Rd != 20; ++Rd)
    Loads = Loads + Words{lw(Rd, 0, 7),
                          encode(Op::RV_ADD, {.Rd = 7, .Rs1 = 7, .Rs2 = 8})};
  const auto EachLoad = [&] {
    return double(cost(20, Loads, Before) - cost(10, Loads, Before)) / 80;
  };
  EXPECT_NEAR(EachLoad(), 32 + 59, 2);
  Settings.Timing.Core.LinesInFlight = 0;
  Settings.Timing.Core.DcacheFillCycles = 0;
  EXPECT_LT(EachLoad(), 55);
}

/// Single numbers, changed in what is otherwise `forwarding`.
using CoreNumbersTest = ClockTest;

TEST_F(CoreNumbersTest, AUnitOfFewLanesBeginsSeveralTimes) {
  const Words Adds = {encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 6, .Rs2 = 7}),
                      encode(Op::RV_ADD, {.Rd = 11, .Rs1 = 6, .Rs2 = 7})};
  for (const unsigned Lanes : {16U, 8U, 5U, 4U, 1U}) {
    Settings.Timing.Core.AluLanes = Lanes;
    const unsigned Passes = (16 + Lanes - 1) / Lanes;
    EXPECT_EQ(cost(50, Adds), 100U * Passes) << Lanes;
  }
}

TEST_F(CoreNumbersTest, SourcesInOneBankAreReadInTurn) {
  const Words SameBank = {encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 14})};
  const Words OtherBank = {
      encode(Op::RV_ADD, {.Rd = 10, .Rs1 = 10, .Rs2 = 15})};
  Settings.Timing.Core.RegisterBanks = 4;
  EXPECT_EQ(cost(50, OtherBank), 50U);
  EXPECT_EQ(cost(50, SameBank), 2U * 50 - 1);
}

TEST_F(CoreNumbersTest, FetchingGoesOnWhileAnInstructionWaits) {
  Settings.Timing.Core.FetchInterval = 4;
  // Behind the wait for a division so many instructions are there at once.
  const Words Wait = {encode(Op::RV_DIVU, {.Rd = 10, .Rs1 = 6, .Rs2 = 7}),
                      addi(10, 10, 0)};
  const Words Adds = repeat(8, {addi(11, 6, 0)});
  for (const unsigned Ahead : {1U, 2U, 3U}) {
    Settings.Timing.Core.FetchAhead = Ahead;
    EXPECT_EQ(run(Wait + Adds).Cycles - run(Wait).Cycles, (8U - Ahead) * 4 + 3)
        << Ahead;
  }
}

} // namespace
