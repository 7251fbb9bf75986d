/// Programs for tests of the clock, and a fixture that says what they take.
#pragma once

#include "raster/RasterTables.h"
#include "testing/ElfBuilder.h"
#include "testing/Instructions.h"
#include "vorion/isasim/Machine.h"

#include <numeric>

namespace vorion::isasim::testing {

using Words = std::vector<uint32_t>;

inline Words operator+(Words A, const Words &B) {
  A.insert(A.end(), B.begin(), B.end());
  return A;
}
inline Words repeat(unsigned Count, const Words &Body) {
  Words All;
  for (unsigned N = 0; N != Count; ++N)
    All = All + Body;
  return All;
}

/// All 16 lanes on; x6: lane number; x7: a word for each lane; x8: the same in
/// local memory.
inline Words program(const Words &Body) {
  return Words{lui(5, 0x10000),
               addi(5, 5, -1),
               encode(Op::VX_TMC, {.Rs1 = 5}),
               csrr(6, CSR_THREAD_ID),
               lui(7, 0x100000),
               encode(Op::RV_SH2ADD, {.Rd = 7, .Rs1 = 6, .Rs2 = 7}),
               lui(8, VX_LOCAL_BASE),
               encode(Op::RV_SH2ADD, {.Rd = 8, .Rs1 = 6, .Rs2 = 8})} +
         Body + Words{encode(Op::VX_TMC, {.Rs1 = 0})};
}

/// The same on every warp of a core.
inline Words onAllWarps(const Words &Body) {
  return Words{csrr(9, CSR_NUM_WARPS), encode(Op::RV_AUIPC, {.Rd = 10}),
               addi(10, 10, 12), encode(Op::VX_WSPAWN, {.Rs1 = 9, .Rs2 = 10})} +
         program(Body);
}

/// Every core (or warp of it) adds 100 times the number in x10 and once more,
/// in a loop of two instructions, then meets \p Count others at a barrier of
/// the device.
inline Words countThenMeet(int32_t Count) {
  return {addi(11, 0, 100),
          encode(Op::RV_MUL, {.Rd = 10, .Rs1 = 10, .Rs2 = 11}),
          addi(10, 10, 1),
          addi(10, 10, -1), // loop
          encode(Op::RV_BNE, {.Rs1 = 10, .Rs2 = 0, .Imm = -4}),
          lui(12, 0x80000000),
          addi(13, 0, Count),
          encode(Op::VX_BAR, {.Rs1 = 12, .Rs2 = 13})};
}

inline Config timed(unsigned Cores = 1) {
  Config C;
  C.SocketsPerCluster = 1;
  C.CoresPerSocket = Cores;
  C.GlobalBytes = 1 << 22;
  C.HostThreads = 1;
  C.Timing.Enabled = true;
  return C;
}

class ClockTest : public ::testing::Test {
protected:
  TimeReport run(const Words &Body) { return runWhole(program(Body)); }
  TimeReport runWhole(const Words &Program) {
    auto M = Machine::create(Settings);
    EXPECT_TRUE(M) << M.error().What;
    (*M)->load(codeImage(Program));
    const RunResult R = (*M)->run();
    EXPECT_EQ(R.End, Outcome::Done) << R.Report;
    for (const CoreTime &T : R.Time->Cores)
      EXPECT_EQ(std::reduce(T.Cycles.begin(), T.Cycles.end()), R.Time->Cycles)
          << "every cycle has one reason";
    for (const RasterTime &T : R.Time->Rasters)
      EXPECT_EQ(std::reduce(T.Cycles.begin(), T.Cycles.end()), R.Time->Cycles);
    return *R.Time;
  }
  /// Cycles that \p Count repetitions of \p Body take, behind \p Before.
  uint64_t cost(unsigned Count, const Words &Body, const Words &Before = {}) {
    return run(Before + repeat(Count, Body)).Cycles - run(Before).Cycles;
  }
  static uint64_t of(const TimeReport &R, CoreCycle What, unsigned Core = 0) {
    return R.Cores[Core].Cycles[size_t(What)];
  }
  static uint64_t activity(const TimeReport &R, std::string_view Unit,
                           std::string_view What) {
    for (const Activity &A : R.Activities)
      if (A.Unit == Unit && A.Event == What)
        return A.Count;
    ADD_FAILURE() << What;
    return 0;
  }

  Config Settings = timed();
};

} // namespace vorion::isasim::testing
