/// Memory behind a link, against closed formulas.
#include "timing/common/Turn.h"
#include "timing/memory/MemorySystem.h"

#include <gtest/gtest.h>
#include <map>

using namespace vorion::isasim;

namespace {

constexpr uint32_t Line = TimingLineBytes;

class MemoryTest : public ::testing::Test {
protected:
  using Times = std::map<uint32_t, uint64_t>; ///< by tag

  /// When each request is answered, its tag being its number. Memory goes on
  /// at most \p Step cycles at a time.
  Times ask(const std::vector<CacheRequest> &Requests,
            uint64_t Step = Turn::Never) {
    MemorySystem M(Params, 1);
    Times Then;
    uint32_t Asked = 0;
    std::vector<Answer> Answers;
    const auto GoOn = [&](uint64_t Until) {
      while (M.nextEvent() <= Until && M.nextEvent() != Turn::Never)
        M.advance(Step == Turn::Never ? Until
                                      : std::min(Until, M.nextEvent() + Step),
                  Answers);
    };
    for (CacheRequest R : Requests) {
      GoOn(R.Now);
      R.From = {0, Asked++};
      if (const auto Known = M.access({}, CacheRequest(R)))
        Then[R.From.Tag] = Known->At;
    }
    GoOn(Turn::Never - 1);
    for (const Answer &A : Answers) {
      EXPECT_FALSE(Then.contains(A.To.Tag)) << "answered twice";
      Then[A.To.Tag] = A.At;
    }
    EXPECT_EQ(Then.size(), Requests.size());
    return Then;
  }
  /// Reads of \p Count lines that are there, one a cycle from cycle \p Now on.
  /// In front of them their lines are written.
  std::vector<CacheRequest> hits(uint32_t Count, uint64_t Now = 1000000) {
    std::vector<CacheRequest> All;
    for (uint32_t N = 0; N != Count; ++N)
      All.push_back(
          {.Now = 10 * N, .Address = N * Line, .Op = CacheOp::WriteWhole});
    for (uint32_t N = 0; N != Count; ++N)
      All.push_back({.Now = Now + N, .Address = N * Line});
    return All;
  }
  double cycles(double Ns) const { return Ns * Params.ClockMhz / 1e3; }

  TimingConfig Params;
};

TEST_F(MemoryTest, AHitTakesTheLinkTwiceAndTheL2sOwnCycles) {
  Params.Link.ToL2Ns = 100;
  Params.Link.FromL2Ns = 40;
  Params.Link.ToL2Mbps = 800;
  Params.Link.FromL2Mbps = 3600;
  for (const uint32_t Mhz : {0U, 100U, 200U, 1000U}) {
    Params.Link.L2Mhz = Mhz;
    const double L2Mhz = Mhz ? Mhz : Params.ClockMhz;
    // 8 bytes there, 72 back.
    const double Ns =
        100 + 40 + 8 / 0.8 + 72 / 3.6 + 1e3 * Params.L2.HitCycles / L2Mhz;
    const Times Then = ask(hits(1));
    EXPECT_NEAR(static_cast<double>(Then.at(1) - 1000000), cycles(Ns),
                2 + cycles(1e3 / L2Mhz))
        << Mhz;
  }
}

TEST_F(MemoryTest, EachWayCarriesSoManyBytes) {
  constexpr uint32_t Count = 1000;
  Params.Link.FromL2Mbps = 1600;
  const Times Reads = ask(hits(Count));
  EXPECT_NEAR(static_cast<double>(Reads.at(2 * Count - 1) - 1000000),
              cycles(Count * 72 / 1.6), 30);
  // Writes have the other way, and are taken as fast as they leave.
  Params.Link.FromL2Mbps = 0;
  Params.Link.ToL2Mbps = 1600;
  std::vector<CacheRequest> Writes;
  for (uint32_t N = 0; N != Count; ++N)
    Writes.push_back(
        {.Now = 0, .Address = N * Line, .Op = CacheOp::WriteWhole});
  EXPECT_NEAR(static_cast<double>(ask(Writes).at(Count - 1)),
              cycles(Count * 72 / 1.6), 30);
}

TEST_F(MemoryTest, TheLinkCountsBytesAndBusyCyclesOfEachDirection) {
  Params.Link.ToL2Mbps = 1600;
  Params.Link.FromL2Mbps = 800;
  MemorySystem M(Params, 1);
  constexpr uint32_t Writes = 100, Reads = 10;
  for (uint32_t N = 0; N != Writes; ++N)
    M.access({}, {.Now = 0, .Address = N * Line, .Op = CacheOp::WriteWhole});
  // The run ends while they leave; the others are the next run's.
  constexpr uint64_t End = 1000;
  TimeReport First, Second;
  M.report(First, End);
  EXPECT_EQ(First.Link.BytesToL2, Writes * 72U);
  EXPECT_EQ(First.Link.BytesFromL2, 0U);
  EXPECT_NEAR(static_cast<double>(First.Link.BusyToL2), End, 1);
  M.begin(End);
  for (uint32_t N = 0; N != Reads; ++N)
    M.access({}, {.Now = 1000000, .Address = N * Line, .From = {0, N}});
  std::vector<Answer> Answers;
  while (M.nextEvent() != Turn::Never)
    M.advance(Turn::Never - 1, Answers);
  M.report(Second, 2000000);
  EXPECT_EQ(Second.Link.BytesToL2, Reads * 8U);
  EXPECT_EQ(Second.Link.BytesFromL2, Reads * 72U);
  EXPECT_NEAR(static_cast<double>(Second.Link.BusyToL2),
              cycles((Writes * 72 + Reads * 8) / 1.6) - End, 2);
  EXPECT_NEAR(static_cast<double>(Second.Link.BusyFromL2),
              cycles(Reads * 72 / 0.8), 2);
}

TEST_F(MemoryTest, AnAnswerKnowsWhenItsMessagesWereOnTheLink) {
  Params.Link.ToL2Ns = 100;
  Params.Link.FromL2Ns = 40;
  Params.Link.FromL2Mbps = 7200; // 10 ns for a line
  MemorySystem M(Params, 1);
  M.access({}, {.Now = 0, .Address = 0, .Op = CacheOp::WriteWhole});
  constexpr uint32_t Reads = 3;
  for (uint32_t N = 0; N != Reads; ++N)
    M.access({}, {.Now = 100000, .Address = 0, .From = {0, N}});
  std::vector<Answer> Answers;
  while (M.nextEvent() != Turn::Never)
    M.advance(Turn::Never - 1, Answers);
  ASSERT_EQ(Answers.size(), Reads);
  for (uint32_t N = 0; N != Reads; ++N) {
    const Arrival A = Answers[N].arrival();
    EXPECT_NEAR(static_cast<double>(A.RequestUntil - 100000), cycles(100), 1);
    // The bank takes one a cycle; a line waits for those before it.
    EXPECT_EQ(A.AnswerFrom, A.RequestUntil + Params.L2.HitCycles + N);
    EXPECT_NEAR(static_cast<double>(A.At - Answers[0].AnswerFrom),
                cycles(10 * (N + 1) + 40), 2);
    uint64_t OnLink = 0, Other = 0, From = 100000;
    A.divide(From, A.At + 5, [&](bool IsLink, uint64_t End) {
      (IsLink ? OnLink : Other) += End - From;
      From = End;
    });
    EXPECT_EQ(Other, Params.L2.HitCycles + N + 5);
    EXPECT_EQ(OnLink + Other, A.At + 5 - 100000);
  }
}

TEST_F(MemoryTest, AHitIsNotHeldUpByALineThatComesLater) {
  Params.Link.FromL2Ns = 50;
  Params.Link.FromL2Mbps = 12800;
  const std::vector<CacheRequest> Alone = hits(1);
  std::vector<CacheRequest> Behind = Alone;
  // A miss, and a hit long before the miss's line is there.
  Behind.insert(Behind.begin() + 1, {.Now = 999990, .Address = 0x100000});
  const Times Then = ask(Behind);
  EXPECT_EQ(Then.at(2), ask(Alone).at(1));
  EXPECT_GT(Then.at(1), Then.at(2));
}

TEST_F(MemoryTest, AShortWideLinkIsAsNone) {
  std::vector<CacheRequest> Requests;
  for (uint32_t N = 0; N != 500; ++N)
    Requests.push_back({.Now = 40 * N, .Address = N * 7919 % 900 * Line});
  const Times None = ask(Requests);
  EXPECT_FALSE(L2Link::exists(Params));
  Params.Link.FromL2Mbps = 1000000;
  ASSERT_TRUE(L2Link::exists(Params));
  const Times Wide = ask(Requests);
  // 72 bytes take 72 ps, which is a cycle at most.
  for (const auto &[Tag, Then] : None)
    EXPECT_NEAR(static_cast<double>(Then), static_cast<double>(Wide.at(Tag)), 2)
        << Tag;
}

TEST_F(MemoryTest, AFixedMemoryTakesALineACycleAndKeepsNone) {
  Params.L2.FixedCycles = 50;
  std::vector<CacheRequest> Requests;
  for (uint32_t N = 0; N != 10; ++N)
    Requests.push_back({.Now = 100,
                        .Address = N / 2 * Line,
                        .Op = N % 3 == 1 ? CacheOp::Write : CacheOp::Read});
  const Times Then = ask(Requests);
  for (uint32_t N = 0; N != 10; ++N)
    EXPECT_EQ(Then.at(N), 100 + N + (N % 3 == 1 ? 0 : 50)) << N;
}

// Who else has a turn, and when, must not matter.
TEST_F(MemoryTest, StepsDoNotMatter) {
  Params.Link = {.L2Mhz = 200,
                 .ToL2Ns = 25,
                 .FromL2Ns = 25,
                 .ToL2Mbps = 3200,
                 .FromL2Mbps = 3200};
  std::vector<CacheRequest> Requests;
  for (uint32_t N = 0; N != 3000; ++N)
    Requests.push_back({.Now = 3 * N,
                        .Address = N / 2 * 7919 % 40000 * Line,
                        .Op = N % 5 == 0   ? CacheOp::Write
                              : N % 7 == 0 ? CacheOp::Atomic
                                           : CacheOp::Read});
  const Times Whole = ask(Requests);
  EXPECT_EQ(ask(Requests, 0), Whole);
  EXPECT_EQ(ask(Requests, 17), Whole);
}

} // namespace
