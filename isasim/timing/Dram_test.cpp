/// DRAM against the formulas of the standard's timing table.
#include "timing/Dram.h"

#include <gtest/gtest.h>

using namespace vorion::isasim;

namespace {

constexpr uint64_t Line = TimingLineBytes;

/// Without refresh, which the formulas leave out.
DramTiming quiet() {
  DramTiming P;
  P.TrefiPs = 0;
  return P;
}

/// The end of a data transfer that may begin at \p Earliest.
uint64_t transferEnd(const DramTiming &P, uint64_t Earliest) {
  const uint64_t Slot = (Earliest + P.BurstPs - 1) / P.BurstPs;
  return (Slot + Line / P.BurstBytes) * P.BurstPs;
}

/// Lines \p Step apart, all wanted at once; returns bytes a nanosecond.
double bandwidth(const DramTiming &P, uint32_t Step, unsigned Count) {
  Dram D(P);
  uint64_t End = 0;
  for (unsigned N = 0; N != Count; ++N)
    End = std::max(End, D.access(0, N * Step, false));
  return static_cast<double>(Count * Line) / (static_cast<double>(End) / 1000);
}

TEST(Dram, AClosedRowIsActivatedFirst) {
  const DramTiming P = quiet();
  Dram D(P);
  EXPECT_EQ(D.access(0, 0, false),
            transferEnd(P, P.ControllerPs + P.TrcdPs + P.TclPs));
  EXPECT_EQ(D.time().RowMisses, 1U);
}

TEST(Dram, AnOpenRowTakesColumnLatencyAlone) {
  const DramTiming P = quiet();
  Dram D(P);
  D.access(0, 0, false);
  constexpr uint64_t Later = 10000000;
  // The next line of the same channel.
  EXPECT_EQ(D.access(Later, P.Channels * Line, false),
            transferEnd(P, Later + P.ControllerPs + P.TclPs));
  EXPECT_EQ(D.time().RowHits, 1U);
}

TEST(Dram, AnotherRowIsPrechargedFirst) {
  const DramTiming P = quiet();
  Dram D(P);
  D.access(0, 0, false);
  constexpr uint64_t Later = 10000000;
  // Row 8 lies in another bank, by its higher bits; row 9's digits sum up to
  // that of row 0 modulo the banks no sooner than row 56 = 070.
  uint32_t Row = 1;
  while (D.time().RowConflicts == 0) {
    const uint64_t End =
        D.access(Later * Row, Row * P.RowBytes * P.Channels, false);
    if (D.time().RowConflicts) {
      EXPECT_EQ(End, transferEnd(P, Later * Row + P.ControllerPs + P.TrpPs +
                                        P.TrcdPs + P.TclPs));
    }
    ASSERT_LT(++Row, 100U);
  }
}

TEST(Dram, AStreamHasTheBusBandwidth) {
  for (const unsigned Channels : {1U, 2U, 8U}) {
    DramTiming P = quiet();
    P.Channels = Channels;
    // 16 bits at 3200 MT/s: 6.4 bytes a nanosecond and channel.
    const double Peak = 6.4 * Channels;
    const double Measured = bandwidth(P, Line, 20000);
    EXPECT_LT(Measured, Peak);
    EXPECT_GT(Measured, 0.98 * Peak) << Channels;
  }
}

TEST(Dram, OneBankIsLimitedByItsRowCycle) {
  DramTiming P = quiet();
  P.Channels = 1;
  P.Banks = 1;
  // A row for each line: tRAS + tRP from one activation to the next.
  const double Expected =
      static_cast<double>(Line) / ((P.TrasPs + P.TrpPs) / 1000.0);
  EXPECT_NEAR(bandwidth(P, P.RowBytes, 2000), Expected, 0.02 * Expected);
}

TEST(Dram, ManyBanksAreLimitedByTheActivationWindow) {
  DramTiming P = quiet();
  P.Channels = 1;
  P.Banks = 64;
  P.TfawPs = 80000; // stricter than 4 tRRD, unlike the default
  const double Expected = 4.0 * Line / (P.TfawPs / 1000.0);
  EXPECT_NEAR(bandwidth(P, P.RowBytes, 4000), Expected, 0.02 * Expected);
}

TEST(Dram, RefreshTakesItsShare) {
  DramTiming P;
  const double Without = bandwidth(quiet(), Line, 1);
  EXPECT_EQ(bandwidth(P, Line, 1), Without) << "none before the first interval";
  Dram D(P);
  // In the middle of the second interval's refresh.
  const uint64_t Now = P.TrefiPs + P.TrfcPs / 2;
  EXPECT_EQ(D.access(Now, 0, false),
            transferEnd(P, P.TrefiPs + P.TrfcPs + P.TrcdPs + P.TclPs));
  EXPECT_EQ(D.time().Refreshes, 1U);
}

TEST(Dram, AReadWaitsForTheTurnaroundAfterAWrite) {
  const DramTiming P = quiet();
  Dram D(P);
  const uint64_t Written = D.access(0, 0, true);
  EXPECT_EQ(D.access(0, P.Channels * Line, false),
            transferEnd(P, Written + P.TwtrPs + P.TclPs));
}

TEST(Dram, ALineTakesWholeBursts) {
  DramTiming P = quiet();
  P.BurstBytes = 38; // two hold 76 bytes
  Dram D(P);
  D.access(0, 0, false);
  EXPECT_EQ(D.time().Reads, 2U);
  EXPECT_EQ(D.time().BusPs, 2U * P.BurstPs);
}

TEST(Dram, ALateMissDoesNotHoldUpARowHit) {
  DramTiming P = quiet();
  P.Channels = 1;
  Dram D(P);
  D.access(0, 0, false);
  constexpr uint64_t Later = 10000000;
  const uint64_t Miss = D.access(Later, P.RowBytes, false);
  const uint64_t Hit = D.access(Later, Line, false);
  EXPECT_LT(Hit, Miss);
}

} // namespace
