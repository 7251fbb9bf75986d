/// DRAM as the last-level cache sees it; the controller has tests of its own.
#include "timing/common/Turn.h"
#include "timing/memory/DramChannels.h"

#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::isasim;

namespace {

using Fills = std::vector<DramChannels::Fill>;

/// Lines of which no two are neighbours, some written, with their times.
void ask(DramChannels &D, unsigned Count, uint64_t Begin = 0) {
  for (uint32_t N = 0; N != Count; ++N) {
    const uint32_t Address = N * 7919 % 4096 * TimingLineBytes;
    if (N % 3 == 0)
      D.writeBack(Begin + 2 * N, Address);
    else
      EXPECT_EQ(D.fetch(Begin + 2 * N, Address, false, N), std::nullopt);
  }
}

uint64_t lastOf(const Fills &All) {
  uint64_t Last = 0;
  for (const auto &F : All)
    Last = std::max(Last, F.At);
  return Last;
}

Fills finish(DramChannels &D) {
  Fills All;
  while (D.nextEvent() != Turn::Never)
    D.advance(Turn::Never, All);
  return All;
}

TEST(DramChannels, ALoneReadTakesTheTablesTime) {
  for (const uint32_t Mhz : {100U, 530U, 5000U}) {
    TimingConfig P;
    P.ClockMhz = Mhz;
    const dram::TimingTable T = setUpDram(P.Dram)->Table;
    DramChannels D(P.Dram, P.ClockMhz);
    const uint64_t Begin = 50;
    D.fetch(Begin, 0x1000, false, 77);
    const Fills All = finish(D);
    ASSERT_EQ(All.size(), 1U);
    EXPECT_EQ(All[0].Miss, 77U);
    // It is taken up in the tick after it came; a line is two bursts.
    const uint64_t Ticks =
        T.CommandTicks[size_t(dram::Command::Activate)] +
        T.sameBank(dram::Command::Activate, dram::Command::Read) +
        T.ReadLatency + 2 * T.BurstTicks;
    const double Ns =
        1e-3 * (static_cast<double>(Ticks * T.TickPs) + P.Dram.ControllerPs);
    const double Cycles = Ns * Mhz / 1e3;
    EXPECT_NEAR(static_cast<double>(All[0].At - Begin), Cycles,
                2 + 1e-6 * Mhz * T.TickPs)
        << Mhz;
  }
}

TEST(DramChannels, ChannelsWorkBesideEachOther) {
  TimingConfig P;
  P.Dram.Channels = 1;
  DramChannels One(P.Dram, P.ClockMhz);
  P.Dram.Channels = 4;
  DramChannels Four(P.Dram, P.ClockMhz);
  for (uint32_t N = 0; N != 4096; ++N) {
    One.fetch(0, N * TimingLineBytes, false, N);
    Four.fetch(0, N * TimingLineBytes, false, N);
  }
  const auto Alone = static_cast<double>(lastOf(finish(One)));
  EXPECT_NEAR(Alone / static_cast<double>(lastOf(finish(Four))), 4, 0.1);
}

// Who else has a turn, and when, must not matter.
TEST(DramChannels, StepsDoNotMatter) {
  TimingConfig P;
  DramChannels Whole(P.Dram, P.ClockMhz);
  ask(Whole, 1000);
  const Fills Expected = finish(Whole);
  EXPECT_EQ(Expected.size(), 666U);
  for (const uint64_t Step : {1U, 3U, 10U, 100U}) {
    DramChannels D(P.Dram, P.ClockMhz);
    ask(D, 1000);
    Fills All;
    for (uint64_t Until = 0; D.nextEvent() != Turn::Never; Until += Step)
      while (D.nextEvent() <= Until)
        D.advance(Until, All);
    ASSERT_EQ(All.size(), Expected.size());
    for (size_t N = 0; N != All.size(); ++N) {
      ASSERT_EQ(All[N].Miss, Expected[N].Miss) << Step;
      ASSERT_EQ(All[N].At, Expected[N].At) << Step;
    }
    EXPECT_EQ(D.time().RowHits, Whole.time().RowHits);
    EXPECT_EQ(D.time().Refreshes, Whole.time().Refreshes);
  }
}

// Counters are taken at the end of runs that may not have used DRAM at all.
TEST(DramChannels, RefreshesWithoutRequestsAreCounted) {
  TimingConfig P;
  DramChannels D(P.Dram, P.ClockMhz);
  const dram::TimingTable T = setUpDram(P.Dram)->Table;
  const uint64_t Interval = uint64_t{T.RefreshInterval} * T.TickPs;
  // When none is under way.
  const auto MiddleAfter = [&](uint64_t Refreshes) {
    return (Refreshes * Interval + Interval / 2) * P.ClockMhz / 1000000;
  };
  D.idleUntil(MiddleAfter(100));
  EXPECT_EQ(D.time().Refreshes, uint64_t{100} * P.Dram.Channels);
  D.clearCounters();
  D.idleUntil(MiddleAfter(107));
  EXPECT_EQ(D.time().Refreshes, uint64_t{7} * P.Dram.Channels);
}

TEST(DramChannels, CountingRefreshesChangesNoTime) {
  for (const uint32_t Mhz : {100U, 530U, 5000U})
    for (const uint64_t Pause : {1U, 1000U, 4133U, 100000U}) {
      TimingConfig P;
      P.ClockMhz = Mhz;
      DramChannels Counted(P.Dram, Mhz), Lazy(P.Dram, Mhz);
      for (DramChannels *D : {&Counted, &Lazy}) {
        ask(*D, 100);
        const uint64_t End = lastOf(finish(*D)) + Pause;
        if (D == &Counted)
          for (uint64_t At = End - Pause; At <= End; At += Pause / 7 + 1)
            D->idleUntil(At);
        ask(*D, 1000, End);
      }
      const Fills All = finish(Counted), Expected = finish(Lazy);
      ASSERT_EQ(All.size(), Expected.size());
      for (size_t N = 0; N != All.size(); ++N)
        ASSERT_EQ(All[N].At, Expected[N].At) << Mhz << ' ' << Pause;
      EXPECT_EQ(Counted.time().Refreshes, Lazy.time().Refreshes);
      EXPECT_EQ(Counted.time().RowHits, Lazy.time().RowHits);
    }
}

// Whoever waits for a line knows it before the line is there, so that what it
// does then is not late.
TEST(DramChannels, NothingIsDecidedLate) {
  TimingConfig P;
  DramChannels D(P.Dram, P.ClockMhz);
  ask(D, 1000);
  while (D.nextEvent() != Turn::Never) {
    const uint64_t Now = D.nextEvent();
    Fills All;
    D.advance(Now, All);
    for (const auto &F : All)
      EXPECT_GE(F.At, Now);
  }
}

TEST(DramChannels, EveryStandardAndMapWorks) {
  for (const std::string_view Standard : dram::standards())
    for (const std::string_view Map : dram::addressMaps()) {
      TimingConfig P;
      P.Dram.Standard = Standard;
      P.Dram.AddressMap = Map;
      DramChannels D(P.Dram, P.ClockMhz);
      ask(D, 300);
      EXPECT_EQ(finish(D).size(), 200U) << Standard << ' ' << Map;
      const DramTime T = D.time();
      EXPECT_EQ(T.RowHits + T.RowMisses + T.RowConflicts + T.Forwarded, 300U);
      EXPECT_EQ((T.ReadBursts + T.WriteBursts) * D.burstBytes(),
                (300 - T.Forwarded) * TimingLineBytes);
      D.clearCounters();
      EXPECT_EQ(D.time().ReadBursts, 0U);
    }
}

TEST(DramChannels, MistakesNameTheKey) {
  const auto Wrong = [](const auto &Change) {
    DramTiming P;
    Change(P);
    const auto Setup = setUpDram(P);
    return Setup ? std::string() : Setup.error().What;
  };
  EXPECT_EQ(Wrong([](DramTiming &) {}), "");
  EXPECT_EQ(
      Wrong([](DramTiming &P) { P.Standard = "ddr3"; }),
      "timing.dram.standard: \"ddr3\" is not a DRAM standard, expected one "
      "of ddr3-1600, ddr4-3200, hbm2e, lpddr4-3200, lpddr5-6400, "
      "ramulator-lpddr4; did you mean ddr3-1600?");
  EXPECT_EQ(Wrong([](DramTiming &P) {
              P.Standard = "/nowhere/t.json";
            }).substr(0, 37),
            "timing.dram.standard: /nowhere/t.json");
  EXPECT_EQ(
      Wrong([](DramTiming &P) { P.AddressMap = "zigzag"; }),
      "timing.dram.address_map: \"zigzag\" is not an address map, expected "
      "one of digit_sum, row_bank_column, xor");
  EXPECT_EQ(Wrong([](DramTiming &P) { P.Channels = 3; }),
            "timing.dram.channels: 3, expected a power of two");
  EXPECT_EQ(Wrong([](DramTiming &P) { P.ChannelBytes = 96; }),
            "timing.dram.channel_bytes: 96, expected a power of two");
  EXPECT_EQ(Wrong([](DramTiming &P) { P.Refresh = "row"; }),
            "timing.dram.refresh: \"row\", expected one of rank, bank, none");
  EXPECT_EQ(Wrong([](DramTiming &P) {
              P.Standard = "ddr3-1600";
              P.Refresh = "bank";
            }),
            "timing.dram: ddr3-1600 has no per-bank refresh: its table has no "
            "bank_refresh_interval");
  EXPECT_EQ(Wrong([](DramTiming &P) { P.ReadQueue = 1; }),
            "timing.dram: a queue has 1 entries for bursts, expected the 2 "
            "bursts of a line");
}

} // namespace
