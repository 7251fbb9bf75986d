/// The controller against the formulas of the standards' tables, and every
/// command that it issues against every constraint.
#include "timing/dram/AddressMap.h"
#include "timing/dram/Replay.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <random>

using namespace vorion::isasim::dram;

namespace {

using RefreshBy = ControllerOptions::RefreshBy;

/// Without refresh, which the formulas leave out.
ControllerOptions quiet() {
  ControllerOptions O;
  O.Refresh = RefreshBy::Nothing;
  return O;
}

TimingTable table(std::string_view Standard) {
  return *standardTable(Standard);
}

struct Outcome {
  std::map<uint64_t, uint64_t> Done; ///< by id
  std::vector<Issued> Commands;
  ControllerCounts Counts;
  uint64_t End = 0;
};

/// Runs until every request is answered once, and checks every command.
Outcome run(const TimingTable &T, const ControllerOptions &O,
            const std::vector<Request> &Requests) {
  EXPECT_TRUE(check(T, O));
  Outcome R;
  Controller C(T, O);
  C.record(&R.Commands);
  for (const Request &Q : Requests)
    C.submit(Q);
  std::vector<Reply> Replies;
  while (C.nextEvent() != Never)
    C.advance(C.nextEvent(), Replies);
  for (const Reply &Y : Replies) {
    EXPECT_TRUE(R.Done.emplace(Y.Id, Y.Done).second) << "answered twice";
    R.End = std::max(R.End, Y.Done);
  }
  EXPECT_EQ(R.Done.size(), Requests.size());
  EXPECT_EQ(firstViolation(T, R.Commands), "");
  R.Counts = C.counts();
  return R;
}

uint32_t burstsOfLine(const TimingTable &T) {
  return std::max(1U, 64 / T.BurstBytes);
}

/// From the first read command of a line until its last byte is there.
uint64_t lineFromRead(const TimingTable &T) {
  return (burstsOfLine(T) - 1) * T.sameBank(Command::Read, Command::Read) +
         T.ReadLatency + T.BurstTicks;
}

/// \p Count lines of \p Step bytes, all at once.
std::vector<Request> stride(const TimingTable &T, uint64_t Step, uint64_t Count,
                            bool IsWrite = false) {
  const AddressDecoder D(*addressMap("xor", T, 1, 64), T);
  std::vector<Request> All;
  for (uint64_t N = 0; N != Count; ++N)
    All.push_back({0, N, N * Step / 64, D(N * Step).Where, IsWrite});
  return All;
}

/// Bytes a nanosecond.
double bandwidth(const TimingTable &T, const Outcome &R) {
  return static_cast<double>(R.Done.size() * 64) /
         (static_cast<double>(R.End) * T.TickPs / 1000);
}

class EveryStandard : public testing::TestWithParam<std::string_view> {};
INSTANTIATE_TEST_SUITE_P(, EveryStandard, testing::ValuesIn(standards()),
                         [](const auto &Info) {
                           std::string Name(Info.param);
                           std::ranges::replace(Name, '-', '_');
                           return Name;
                         });

TEST_P(EveryStandard, LatencyIsThatOfTheTable) {
  const TimingTable T = table(GetParam());
  constexpr uint64_t Later = 100000;
  // Rows 0, 0 and 1 of bank 0, far apart: closed, open and in conflict.
  const Outcome R = run(T, quiet(),
                        {{Later, 0, 0, {0, 0}, false},
                         {2 * Later, 1, 1, {0, 0}, false},
                         {3 * Later, 2, 2, {0, 1}, false}});
  const uint64_t Activate = T.sameBank(Command::Activate, Command::Read);
  const uint64_t Precharge = T.sameBank(Command::Precharge, Command::Activate);
  // A command takes the bus from the tick after arrival on.
  const auto Issue = [&T](Command C) { return T.CommandTicks[size_t(C)]; };
  EXPECT_EQ(R.Done.at(0),
            Later + Issue(Command::Activate) + Activate + lineFromRead(T));
  EXPECT_EQ(R.Done.at(1), 2 * Later + Issue(Command::Read) + lineFromRead(T));
  EXPECT_EQ(R.Done.at(2), 3 * Later + Issue(Command::Precharge) + Precharge +
                              Activate + lineFromRead(T));
  EXPECT_EQ(R.Counts.RowMisses, 1U);
  EXPECT_EQ(R.Counts.RowHits, 1U);
  EXPECT_EQ(R.Counts.RowConflicts, 1U);
}

TEST_P(EveryStandard, AStreamHasNearlyThePeak) {
  const TimingTable T = table(GetParam());
  for (const bool IsWrite : {false, true}) {
    const double Measured =
        bandwidth(T, run(T, quiet(), stride(T, 64, 4000, IsWrite)));
    EXPECT_LE(Measured, T.peakBandwidth());
    EXPECT_GT(Measured, 0.95 * T.peakBandwidth()) << IsWrite;
  }
}

TEST_P(EveryStandard, ReadsAfterAWriteWaitForTheTurnaround) {
  const TimingTable T = table(GetParam());
  const Outcome R = run(T, quiet(),
                        {{1000, 0, 0, {0, 0}, true},
                         {1300, 1, 1, {0, 0}, true},
                         {1301, 2, 2, {0, 0}, false}});
  const auto IsOf = [](Command C) {
    return [C](const Issued &I) { return I.What == C; };
  };
  const auto FirstRead = std::ranges::find_if(R.Commands, IsOf(Command::Read));
  const auto LastWrite = std::find_if(std::make_reverse_iterator(FirstRead),
                                      R.Commands.rend(), IsOf(Command::Write));
  EXPECT_EQ(FirstRead->At - LastWrite->At,
            T.sameBank(Command::Write, Command::Read));
}

TEST_P(EveryStandard, OneBankIsLimitedByItsRowCycle) {
  const TimingTable T = table(GetParam());
  std::vector<Request> All;
  for (uint64_t N = 0; N != 1000; ++N)
    All.push_back({0, N, N, {0, uint32_t(N)}, false});
  const uint64_t OpenFor =
      T.sameBank(Command::Activate, Command::Read) +
      (burstsOfLine(T) - 1) * T.sameBank(Command::Read, Command::Read) +
      T.sameBank(Command::Read, Command::Precharge);
  const double Cycle = static_cast<double>(std::max<uint64_t>(
      T.sameBank(Command::Activate, Command::Activate),
      OpenFor + T.sameBank(Command::Precharge, Command::Activate)));
  const auto Ticks = static_cast<double>(run(T, quiet(), All).End) / 1000;
  EXPECT_NEAR(Ticks, Cycle, 0.01 * Cycle);
}

TEST_P(EveryStandard, ActivationsKeepTheirWindow) {
  const TimingTable T = table(GetParam());
  // A row for each line, all banks in turn, the groups first.
  std::vector<Request> All;
  for (uint64_t N = 0; N != 2000; ++N) {
    const uint64_t Bank =
        N % T.BankGroups * T.BanksPerGroup + N / T.BankGroups % T.BanksPerGroup;
    All.push_back({0, N, N, {uint32_t(Bank), uint32_t(N)}, false});
  }
  uint64_t Window = 0;
  uint64_t Apart = 0;
  for (const Constraint &C : T.Constraints)
    if (C.From == Command::Activate && C.To == Command::Activate &&
        C.Within == Scope::Rank)
      (C.Window == 4 ? Window : Apart) = C.Ticks;
  const double OfLine = std::max(
      {static_cast<double>(Window) / 4, static_cast<double>(Apart),
       static_cast<double>(burstsOfLine(T) * T.BurstTicks),
       T.HasColumnBus
           ? 0.0
           : static_cast<double>(T.CommandTicks[size_t(Command::Activate)] +
                                 (T.SecondActivateWithin != 0) +
                                 T.CommandTicks[size_t(Command::Precharge)] +
                                 burstsOfLine(T) *
                                     T.CommandTicks[size_t(Command::Read)]),
       static_cast<double>(T.sameBank(Command::Activate, Command::Activate)) /
           T.banks()});
  const auto Ticks = static_cast<double>(run(T, quiet(), All).End) / 2000;
  EXPECT_GE(Ticks, OfLine);
  EXPECT_LT(Ticks, 1.15 * OfLine);
}

TEST_P(EveryStandard, RefreshTakesItsShareUnderLoad) {
  const TimingTable T = table(GetParam());
  const auto All = stride(T, 64, 12000);
  const auto Without = static_cast<double>(run(T, quiet(), All).End);
  const Outcome R = run(T, {}, All);
  const auto With = static_cast<double>(R.End);
  const double Share = (With - Without) / With;
  const double Refreshes = std::floor(With / T.RefreshInterval);
  EXPECT_EQ(static_cast<double>(R.Counts.Refreshes), Refreshes);
  const double Shortest = T.sameBank(Command::Refresh, Command::Activate);
  const double Longest = Shortest +
                         T.sameBank(Command::Activate, Command::PrechargeAll) +
                         T.sameBank(Command::PrechargeAll, Command::Refresh) +
                         2 * T.sameBank(Command::Activate, Command::Read);
  // A refresh closes rows that were to be closed anyway.
  EXPECT_GT(Share, 0.85 * Refreshes * Shortest / With);
  EXPECT_LT(Share, Refreshes * Longest / With);
}

TEST(Controller, RefreshByBankLeavesTheOtherBanks) {
  const TimingTable T = table("lpddr4-3200");
  std::mt19937_64 Draw(1);
  std::vector<Request> All;
  for (uint64_t N = 0; N != 8000; ++N)
    All.push_back(
        {0, N, N, {uint32_t(Draw() % 8), uint32_t(Draw() % 64)}, false});
  ControllerOptions ByBank;
  ByBank.Refresh = RefreshBy::Bank;
  const Outcome Banks = run(T, ByBank, All);
  EXPECT_LT(Banks.End, run(T, {}, All).End);
  EXPECT_GT(Banks.End, run(T, quiet(), All).End);
  // The last may still be due.
  EXPECT_NEAR(static_cast<double>(Banks.Counts.Refreshes),
              static_cast<double>(Banks.End) / T.BankRefreshInterval, 2);
}

TEST(Controller, AnIdleChannelIsRefreshedToo) {
  const TimingTable T = table("lpddr4-3200");
  Controller C(T);
  EXPECT_EQ(C.nextEvent(), Never);
  std::vector<Reply> Replies;
  const uint64_t Later = 1000 * uint64_t{T.RefreshInterval} + 10;
  C.submit({Later, 7, 0, {0, 0}, false});
  C.advance(Later + 10000, Replies);
  EXPECT_EQ(C.counts().Refreshes, 1001U);
  // The last refresh before it is still under way.
  ASSERT_EQ(Replies.size(), 1U);
  EXPECT_EQ(Replies[0].Done,
            Later - 10 + T.CommandTicks[size_t(Command::Refresh)] - 1 +
                T.sameBank(Command::Refresh, Command::Activate) +
                T.sameBank(Command::Activate, Command::Read) + lineFromRead(T));
  EXPECT_EQ(C.nextEvent(), Never);
}

TEST(Controller, AnOlderRequestWaitsForAsManyHitsAsTheCapSays) {
  const TimingTable T = table("lpddr4-3200");
  for (const uint32_t Cap : {2U, 16U, 40U}) {
    ControllerOptions O = quiet();
    O.RowHitCap = Cap;
    // The second request conflicts; more hits come than the queue holds.
    std::vector<Request> All = {{0, 0, 0, {0, 0}, false},
                                {0, 1, 1000, {0, 1}, false}};
    for (uint64_t N = 2; N != 400; ++N)
      All.push_back({0, N, N, {0, 0}, false});
    const Outcome R = run(T, O, All);
    const auto Closed =
        std::find_if(R.Commands.begin(), R.Commands.end(), [](const Issued &I) {
          return I.What == Command::Precharge;
        });
    const auto Hits =
        std::count_if(R.Commands.begin(), Closed,
                      [](const Issued &I) { return I.What == Command::Read; });
    EXPECT_EQ(Hits, Cap + 1);
  }
}

TEST(Controller, WritesThatKeepComingDoNotStopReads) {
  const TimingTable T = table("lpddr4-3200");
  ControllerOptions O = quiet();
  O.MostDrained = 100;
  std::vector<Request> All;
  for (uint64_t N = 0; N != 4000; ++N)
    All.push_back({0, N, N, {uint32_t(N % 8), uint32_t(N / 256)}, true});
  All.push_back({500, 4000, 9999, {0, 77}, false});
  const Outcome R = run(T, O, All);
  // The drain, both turnarounds and a row.
  const uint64_t Longest =
      500 + (O.MostDrained + 2) * T.BurstTicks +
      2 * T.sameBank(Command::Activate, Command::Activate) +
      T.sameBank(Command::Write, Command::Precharge) + lineFromRead(T);
  EXPECT_LT(R.Done.at(4000), Longest);
  // The reads' turn does not end it.
  EXPECT_EQ(R.Counts.Drains, 1U);
}

TEST(Controller, AReadTakesWhatAWaitingWriteHolds) {
  const TimingTable T = table("lpddr4-3200");
  const Outcome R =
      run(T, quiet(), {{100, 0, 5, {0, 0}, true}, {100, 1, 5, {0, 0}, false}});
  EXPECT_EQ(R.Done.at(1), 101U);
  EXPECT_EQ(R.Counts.Forwarded, 1U);
  EXPECT_EQ(R.Counts.Reads, 0U);
}

TEST(Controller, ARowThatNobodyWaitsForIsClosedOnRequest) {
  const TimingTable T = table("lpddr4-3200");
  ControllerOptions O = quiet();
  O.CloseRowAfter = 0;
  const Outcome R = run(T, O,
                        {{1000, 0, 0, {0, 0}, false},
                         {1000, 1, 1, {0, 0}, false},
                         {5000, 2, 2, {0, 1}, false}});
  EXPECT_EQ(R.Counts.RowHits, 1U);
  EXPECT_EQ(R.Counts.RowConflicts, 0U);
  EXPECT_EQ(R.Done.at(2), 5000 + T.CommandTicks[size_t(Command::Activate)] +
                              T.sameBank(Command::Activate, Command::Read) +
                              lineFromRead(T));
}

TEST(Controller, AnOpenedRowIsUsedBeforeItIsClosed) {
  TimingTable T = table("ddr4-3200");
  for (Constraint &C : T.Constraints)
    if (C.From == Command::Read && C.To == Command::Read)
      C.Ticks = 400;
  // The read of row 1 has to wait for that of bank 4, until long after its row
  // could be closed for row 2.
  const std::vector<Request> All = {{10, 0, 0, {4, 0}, false},
                                    {11, 1, 1, {0, 1}, false},
                                    {12, 2, 2, {0, 2}, false}};
  EXPECT_EQ(run(T, quiet(), All).Counts.Activations, 3U);
  // Nor is it closed for a refresh.
  ControllerOptions O;
  T.RefreshInterval = 200;
  for (Constraint &C : T.Constraints)
    if (C.From == Command::Refresh)
      C.Ticks = 50;
  EXPECT_EQ(run(T, O, {All[0], All[1]}).Counts.Activations, 2U);
}

/// Where each second half of an activation comes, in ticks behind the first,
/// and how many reads come in between.
std::pair<std::vector<uint64_t>, unsigned> halves(const Outcome &R) {
  std::vector<uint64_t> Behind;
  unsigned Between = 0;
  const Issued *First = nullptr;
  for (const Issued &I : R.Commands)
    if (I.What == Command::Activate) {
      First = &I;
    } else if (I.What == Command::Activate2) {
      Behind.push_back(I.At - First->At);
      First = nullptr;
    } else {
      Between += First != nullptr;
    }
  return {Behind, Between};
}

/// \p Hits lines of row 0 of banks in two groups, and one of a third group that
/// comes meanwhile.
std::vector<Request> hitsAndAMiss(const TimingTable &T, uint64_t Hits) {
  std::vector<Request> All;
  for (uint64_t N = 0; N != Hits; ++N)
    All.push_back({0, N, N, {uint32_t(N % 2 * T.BanksPerGroup), 0}, false});
  All.push_back({60, Hits, Hits, {2 * T.BanksPerGroup, 7}, false});
  return All;
}

TEST(Controller, ASecondHalfOfAnActivationTakesTheNextFreeTick) {
  const TimingTable T = table("lpddr5-6400");
  ASSERT_NE(T.SecondActivateWithin, 0U);
  const auto [Alone, None] =
      halves(run(T, quiet(), {{10, 0, 0, {3, 1}, false}}));
  EXPECT_EQ(Alone, std::vector<uint64_t>{1});
  EXPECT_EQ(None, 0U);
  // A stream keeps every second tick; an activation costs it nothing.
  const std::vector<Request> All = hitsAndAMiss(T, 30);
  const Outcome R = run(T, quiet(), All);
  const auto [Behind, Between] = halves(R);
  EXPECT_EQ(Behind.size(), 3U);
  EXPECT_LE(Behind.back(), 2U);
  std::vector<uint64_t> Reads;
  for (const Issued &I : R.Commands)
    if (I.What == Command::Read && I.At > 60)
      Reads.push_back(I.At);
  EXPECT_EQ(Reads.back() - Reads.front(), (Reads.size() - 1) * T.BurstTicks);
}

TEST(Controller, ASecondHalfOfAnActivationIsNotTooLate) {
  // Reads that could take every tick of the command bus.
  TimingTable T = table("lpddr5-6400");
  T.BurstTicks = 1;
  for (Constraint &C : T.Constraints)
    if (C.From == Command::Read && C.To == Command::Read)
      C.Ticks = 1;
  for (const uint32_t Within : {1U, 3U, 8U}) {
    T.SecondActivateWithin = Within;
    const auto [Behind, Between] = halves(run(T, quiet(), hitsAndAMiss(T, 30)));
    EXPECT_EQ(Behind.back(), Within);
    EXPECT_EQ(Between, Within - 1);
  }
}

TEST(Replay, TheHalvesOfAnActivationBelongTogether) {
  const TimingTable T = table("lpddr5-6400");
  const Issued First{100, Command::Activate, {0, 1}};
  const auto With = [&](std::vector<Issued> Others) {
    Others.insert(Others.begin(), First);
    return firstViolation(T, Others);
  };
  EXPECT_EQ(With({{101, Command::Activate2, {0, 1}}}), "");
  EXPECT_EQ(With({{108, Command::Activate2, {0, 1}}}), "");
  EXPECT_EQ(With({{109, Command::Activate2, {0, 1}}}),
            "command 1, ACT2 at 109 to bank 0, is too late for the second half "
            "of an activation");
  EXPECT_EQ(With({{104, Command::Activate, {4, 1}}}),
            "command 1, ACT at 104 to bank 4, is between the halves of an "
            "activation");
  EXPECT_EQ(With({{115, Command::Read, {0, 1}}}),
            "command 1, RD at 115 to bank 0, is too late for the second half "
            "of an activation");
  EXPECT_EQ(firstViolation(T, {{101, Command::Activate2, {0, 1}}}),
            "command 0, ACT2 at 101 to bank 0, is the second half of no "
            "activation");
}

TEST(Controller, AFullQueueSaysSo) {
  const TimingTable T = table("lpddr4-3200");
  Controller C(T, quiet());
  EXPECT_EQ(C.room(false), 32U);
  for (uint64_t N = 0; N != 40; ++N)
    C.submit({10, N, N, {0, 0}, false});
  EXPECT_EQ(C.room(false), 0U);
  EXPECT_EQ(C.room(true), 32U);
}

TEST(Controller, OptionsThatCannotBeAreRefused) {
  const auto Problem = [](std::string_view Standard, auto Change) {
    ControllerOptions O;
    Change(O);
    const auto Good = check(table(Standard), O);
    return Good ? std::string() : Good.error().What;
  };
  using Options = ControllerOptions;
  EXPECT_EQ(
      Problem("ddr3-1600", [](Options &O) { O.Refresh = RefreshBy::Bank; }),
      "ddr3-1600 has no per-bank refresh: its table has no "
      "bank_refresh_interval");
  EXPECT_EQ(
      Problem("hbm2e", [](Options &O) { O.WriteQueue = 1; }),
      "a queue has 1 entries for bursts, expected the 2 bursts of a line");
  EXPECT_EQ(Problem("hbm2e", [](Options &O) { O.DrainBelow = 90; }),
            "writes are drained above 80 % until below 90 %, expected at most "
            "100 and the lower threshold not above the upper");
}

/// Reads and writes of a few rows, in bursts of equal times.
std::vector<Request> randomLoad(const TimingTable &T, uint64_t Seed,
                                uint64_t Count) {
  std::mt19937_64 Draw(Seed);
  const uint64_t Rows = 1 + Draw() % 20;
  const uint64_t Gap = 1 + Draw() % 40;
  const uint64_t Writes = Draw() % 100;
  std::vector<Request> All;
  uint64_t At = 0;
  for (uint64_t N = 0; N != Count; ++N) {
    if (Draw() % 3 == 0)
      At += Draw() % Gap;
    if (Draw() % 500 == 0)
      At += Draw() % 20000;
    const Place Where{uint32_t(Draw() % T.banks()), uint32_t(Draw() % Rows)};
    const uint64_t Line =
        (uint64_t{Where.Row} * T.banks() + Where.Bank) * 16 + Draw() % 16;
    All.push_back({At, N, Line, Where, Draw() % 100 < Writes});
  }
  return All;
}

ControllerOptions randomOptions(const TimingTable &T, uint64_t Seed) {
  std::mt19937_64 Draw(Seed + 1000);
  ControllerOptions O;
  O.ReadQueue = static_cast<uint32_t>(2 + Draw() % 64);
  O.WriteQueue = static_cast<uint32_t>(2 + Draw() % 64);
  O.DrainAbove = static_cast<uint32_t>(Draw() % 101);
  O.DrainBelow = static_cast<uint32_t>(Draw() % (O.DrainAbove + 1));
  O.MostDrained = static_cast<uint32_t>(1 + Draw() % 300);
  O.RowHitCap = static_cast<uint32_t>(Draw() % 20);
  if (Draw() % 2)
    O.CloseRowAfter = Draw() % 200;
  O.Refresh = static_cast<RefreshBy>(Draw() % 3);
  if (T.BankRefreshInterval == 0 && O.Refresh == RefreshBy::Bank)
    O.Refresh = RefreshBy::Rank;
  return O;
}

TEST_P(EveryStandard, AnyLoadIsAnsweredByTheTable) {
  const TimingTable T = table(GetParam());
  for (uint64_t Seed = 0; Seed != 12; ++Seed) {
    SCOPED_TRACE(Seed);
    run(T, randomOptions(T, Seed), randomLoad(T, Seed, 1500));
  }
}

TEST_P(EveryStandard, TheOrderOfCallsDoesNotMatter) {
  const TimingTable T = table(GetParam());
  for (uint64_t Seed = 0; Seed != 4; ++Seed) {
    SCOPED_TRACE(Seed);
    const ControllerOptions O = randomOptions(T, Seed);
    std::vector<Request> All = randomLoad(T, Seed, 800);
    const Outcome Whole = run(T, O, All);
    std::vector<Request> Shuffled = All;
    std::ranges::shuffle(Shuffled, std::mt19937_64(Seed));
    EXPECT_EQ(run(T, O, Shuffled).Done, Whole.Done);
    // Handed over as late as may be, each tick's the other way round, with
    // idle calls between.
    Controller C(T, O);
    std::vector<Reply> Replies;
    for (size_t N = 0; N != All.size();) {
      size_t End = N;
      while (End != All.size() && All[End].At == All[N].At)
        ++End;
      if (All[N].At != 0)
        C.advance(All[N].At - 1, Replies);
      for (size_t I = End; I-- != N;)
        C.submit(All[I]), C.nextEvent();
      C.advance(All[N].At, Replies);
      N = End;
    }
    while (C.nextEvent() != Never)
      C.advance(C.nextEvent() + 17, Replies);
    std::map<uint64_t, uint64_t> Done;
    for (const Reply &R : Replies)
      Done.emplace(R.Id, R.Done);
    EXPECT_EQ(Done, Whole.Done);
  }
}

/// Two ranks: the table of one, and what is between them.
TEST(Controller, RanksShareTheBus) {
  TimingTable T = table("ddr4-3200");
  T.Ranks = 2;
  const uint32_t Switch = T.BurstTicks + 2;
  using C = Command;
  T.Constraints.push_back({C::Read, C::Read, Scope::OtherRanks, Switch});
  T.Constraints.push_back({C::Write, C::Write, Scope::OtherRanks, Switch});
  for (uint64_t Seed = 0; Seed != 8; ++Seed) {
    SCOPED_TRACE(Seed);
    run(T, randomOptions(T, Seed), randomLoad(T, Seed, 1500));
  }
}

} // namespace
