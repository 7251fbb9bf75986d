/// The cache behind a crossbar, against closed formulas.
#include "timing/memory/CrossbarCache.h"

#include "timing/common/Turn.h"

#include <gtest/gtest.h>
#include <map>
#include <random>

using namespace vorion::isasim;

namespace {

constexpr uint32_t Line = TimingLineBytes;

/// Memory that takes a line a cycle, in order, and remembers when.
class Port final : public MemoryBelow {
public:
  static constexpr uint64_t Latency = 50;
  std::optional<uint64_t> fetch(uint64_t Now, uint32_t Address, bool,
                                uint32_t) override {
    Read.emplace_back(Now, Address);
    return Now + Latency;
  }
  void writeBack(uint64_t Now, uint32_t Address) override {
    Written.emplace_back(Now, Address);
  }
  std::vector<std::pair<uint64_t, uint32_t>> Read, Written;
};

constexpr CacheShape Shape{.Bytes = 1 << 20,
                           .Ways = 1,
                           .Banks = 4,
                           .Mshrs = 16,
                           .HitCycles = 12,
                           .Hint = false,
                           .WriteThrough = true};
constexpr uint32_t Ports = 4, Banks = 16; ///< of a port: its queues

class CrossbarTest : public ::testing::Test {
protected:
  using Times = std::map<uint32_t, uint64_t>; ///< by number

  explicit CrossbarTest(const CacheShape &Of = Shape)
      : C(Of, 2, Ports, Banks, Below) {}

  /// Waits in \p Of from \p Now on; returns its number.
  uint32_t ask(uint32_t Of, uint64_t Now, uint32_t Address,
               CacheOp Op = CacheOp::Read, uint32_t Extra = 0) {
    CacheRequest R{.Now = Now, .Address = Address, .Op = Op, .Extra = Extra};
    R.Port = Of;
    R.From = {0, Asked};
    R.Dequeued = {1, Asked};
    C.access(R);
    return Asked++;
  }
  /// Goes on until nothing is under way.
  void finish() {
    std::vector<Answer> Answers;
    while (C.nextEvent() != Turn::Never) {
      ASSERT_GE(C.nextEvent(), Cycle);
      Cycle = C.nextEvent();
      C.step(Answers);
    }
    for (const Answer &A : Answers) {
      Times &Of = A.To.Unit ? Left : Done;
      EXPECT_FALSE(Of.contains(A.To.Tag)) << "answered twice";
      Of[A.To.Tag] = A.At;
    }
    EXPECT_EQ(Done.size(), Asked);
    EXPECT_EQ(Left.size(), Asked);
  }
  /// Reads \p Count lines from \p Address on, so that they are there.
  void warm(uint32_t Address, uint32_t Count) {
    for (uint32_t N = 0; N != Count; ++N)
      ask(0, 0, Address + N * Line);
    finish();
    Below.Read.clear();
  }

  Port Below;
  CrossbarCache C;
  uint32_t Asked = 0;
  uint64_t Cycle = 0;
  Times Done, Left;
};

TEST_F(CrossbarTest, AHitTakesItsCyclesAndAMissThoseOfTheWayBelow) {
  const uint32_t Miss = ask(0, 100, 0);
  finish();
  // Two stages, a queue and the port down; a cycle between fill and replay.
  EXPECT_EQ(Below.Read.front().first, 100U + 4);
  EXPECT_EQ(Done.at(Miss), 100 + 4 + Port::Latency + 2 + Shape.HitCycles);
  const uint32_t Hit = ask(3, 1000, Line - 4);
  finish();
  EXPECT_EQ(Done.at(Hit), 1000U + Shape.HitCycles);
  EXPECT_EQ(C.time().Hits, 1U);
  EXPECT_EQ(C.time().Reads, 2U);
}

TEST_F(CrossbarTest, APortSendsAndReceivesALineACycle) {
  constexpr uint32_t Lines = 64;
  warm(0, Lines);
  const uint32_t First = Asked;
  for (uint32_t N = 0; N != Lines; ++N)
    ask(1, 1000, N * Line);
  finish();
  for (uint32_t N = 0; N != Lines; ++N)
    EXPECT_EQ(Done.at(First + N), 1000 + N + Shape.HitCycles) << N;
}

TEST_F(CrossbarTest, ABankTakesTheLowestPortFirst) {
  warm(0, 4 * Ports);
  const uint32_t First = Asked;
  // Lines 0, 4, 8 and 12 are in one bank.
  for (uint32_t P = Ports; P-- != 0;)
    ask(P, 1000, 4 * P * Line);
  finish();
  for (uint32_t N = 0; N != Ports; ++N)
    EXPECT_EQ(Done.at(First + N), 1000 + (Ports - 1 - N) + Shape.HitCycles);
  EXPECT_EQ(C.time().BankCycles, 0U + 1 + 2 + 3);
}

TEST_F(CrossbarTest, PortsOfDifferentBanksDoNotMeet) {
  warm(0, 4 * Ports);
  const uint32_t First = Asked;
  for (uint32_t P = 0; P != Ports; ++P)
    ask(P, 1000, P * Line);
  finish();
  for (uint32_t N = 0; N != Ports; ++N)
    EXPECT_EQ(Done.at(First + N), 1000U + Shape.HitCycles);
}

// What 1, 2 and 4 cores write goes to memory, a line a cycle in all.
TEST_F(CrossbarTest, WritesOfAllPortsLeaveALineACycle) {
  constexpr uint32_t Lines = 64;
  uint64_t Begin = 100;
  for (const uint32_t Cores : {1U, 2U, 4U}) {
    Below.Written.clear();
    for (uint32_t P = 0; P != Cores; ++P)
      for (uint32_t N = 0; N != Lines; ++N)
        ask(P, Begin, (P * 1000 + N) * Line, CacheOp::WriteWhole);
    finish();
    ASSERT_EQ(Below.Written.size(), Cores * Lines);
    EXPECT_EQ(Below.Written.back().first - Below.Written.front().first,
              Cores * Lines - 1);
    EXPECT_TRUE(Below.Read.empty());
    Begin += 10000;
  }
}

TEST_F(CrossbarTest, APortIsHeldUpWhileALowerOneHasItsBank) {
  // All of one bank, which port 0 never leaves.
  for (uint32_t P = 0; P != 2; ++P)
    for (uint32_t N = 0; N != 100; ++N)
      ask(P, 100, 4 * N * Line, CacheOp::Write);
  finish();
  for (uint32_t N = 0; N != 100; ++N) {
    EXPECT_NEAR(double(Done.at(N)), 100 + N, 4) << N;
    EXPECT_NEAR(double(Done.at(100 + N)), 200 + N, 8) << N;
    // A buffer of four is between a port's queues and the crossbar.
    EXPECT_NEAR(double(Left.at(100 + N)), N < 4 ? 98 + N : 196 + N, 8) << N;
  }
}

/// Misses of one bank, \p Count of them with \p Mshrs; when the last is
/// answered.
uint64_t lastOfMisses(uint32_t Count, uint32_t Mshrs) {
  CacheShape One = Shape;
  One.Mshrs = Mshrs;
  One.Banks = 1;
  Port Below;
  CrossbarCache C(One, 2, 1, 1, Below);
  for (uint32_t N = 0; N != Count; ++N)
    C.access({.Now = 100, .Address = N * Line, .From = {0, N}});
  std::vector<Answer> Answers;
  while (C.nextEvent() != Turn::Never)
    C.step(Answers);
  EXPECT_EQ(Answers.size(), Count);
  return Answers.back().At;
}

// The look-up; then the fill, a cycle behind it and the replay.
TEST(Crossbar, AMissTakesFourCyclesOfItsBank) {
  EXPECT_NEAR(double(lastOfMisses(1000, 256) - lastOfMisses(500, 256)),
              4.0 * 500, 60);
}

TEST(Crossbar, MshrsBoundTheMissesInFlight) {
  // As many as there are take the way down, memory's time and three cycles
  // each.
  for (const uint32_t Mshrs : {1U, 2U, 4U, 16U})
    EXPECT_NEAR(double(lastOfMisses(40 * Mshrs, Mshrs)),
                100 + 40 * (4 + Port::Latency + 3.0 * Mshrs), 60)
        << Mshrs;
}

TEST_F(CrossbarTest, MissesOfALineAreOneRequestBelow) {
  for (uint32_t P = 0; P != Ports; ++P)
    ask(P, 100, 40);
  finish();
  EXPECT_EQ(Below.Read.size(), 1U);
  EXPECT_EQ(C.time().Merged, Ports - 1);
  // They are answered one after the other.
  for (uint32_t P = 1; P != Ports; ++P)
    EXPECT_EQ(Done.at(P), Done.at(0) + P);
}

TEST_F(CrossbarTest, AWriteThatMissesAllocatesNothing) {
  ask(0, 100, 0, CacheOp::Write);
  finish();
  ask(0, 200, 0);
  finish();
  EXPECT_EQ(C.time().Hits, 0U);
  EXPECT_EQ(Below.Read.size(), 1U);
  EXPECT_EQ(Below.Written.size(), 1U);
  // Nothing is left to write.
  EXPECT_EQ(C.flush(1000), 1000U);
}

TEST_F(CrossbarTest, AnAtomicHoldsItsBankAndIsWrittenThrough) {
  warm(0, 5);
  const uint32_t Atomic = ask(0, 1000, 0, CacheOp::Atomic, 7);
  const uint32_t Behind = ask(1, 1001, 4 * Line);
  finish();
  EXPECT_EQ(Done.at(Atomic), 1000U + Shape.HitCycles + 7);
  EXPECT_EQ(Done.at(Behind), 1000U + 8 + Shape.HitCycles);
  EXPECT_EQ(Below.Written.size(), 1U);
  EXPECT_EQ(C.time().Atomics, 1U);
}

class WriteBackTest : public CrossbarTest {
protected:
  static CacheShape shape() {
    CacheShape S = Shape;
    S.WriteThrough = false;
    return S;
  }
  WriteBackTest() : CrossbarTest(shape()) {}
};

TEST_F(WriteBackTest, AWrittenLineStaysUntilItIsReplaced) {
  ask(0, 100, 0, CacheOp::WriteWhole);
  ask(0, 110, Line, CacheOp::Write);
  finish();
  // A part of a line needs the rest.
  EXPECT_EQ(Below.Read.size(), 1U);
  EXPECT_TRUE(Below.Written.empty());
  ask(1, 1000, 0);
  ask(1, 1000, Line);
  finish();
  EXPECT_EQ(C.time().Hits, 2U);
  ask(0, 2000, Shape.Bytes); // has the place of line 0
  finish();
  EXPECT_EQ(Below.Written.size(), 1U);
  EXPECT_EQ(C.flush(5000), 5001U);
  EXPECT_EQ(Below.Written.back(), (std::pair<uint64_t, uint32_t>(5000, Line)));
}

// Whatever is asked, all is answered once, in a port in the order of asking.
TEST_F(WriteBackTest, EveryRequestIsAnsweredOnce) {
  std::minstd_rand Random(1);
  uint64_t Now = 0;
  for (unsigned N = 0; N != 5000; ++N) {
    Now += Random() % 3;
    ask(Random() % Ports, Now, (Random() % 40 * 4096 + Random() % 8) * Line,
        static_cast<CacheOp>(Random() % 4), Random() % 3);
  }
  finish();
  EXPECT_GT(C.time().Writebacks, 100U);
}

} // namespace
