/// The cache against closed formulas and a naive model.
#include "timing/memory/Cache.h"

#include "timing/memory/MemoryWatch.h"

#include <array>
#include <gtest/gtest.h>
#include <list>
#include <rapidcheck/gtest.h>

using namespace vorion::isasim;

namespace {

constexpr uint32_t Line = TimingLineBytes;

/// Memory that takes a fixed time, and remembers what it was asked.
class Slow final : public MemoryBelow {
public:
  static constexpr uint64_t Latency = 1000;
  std::optional<uint64_t> fetch(uint64_t Now, uint32_t, bool,
                                uint32_t Miss) override {
    ++Fetches;
    if (!IsOpen)
      return Now + Latency;
    Open.push_back({Miss, Now + Latency});
    return std::nullopt;
  }
  void writeBack(uint64_t, uint32_t Address) override {
    Written.push_back(Address);
  }
  unsigned Fetches = 0;
  std::vector<uint32_t> Written;
  bool IsOpen = false; ///< whether it says later when a line is there
  struct Promise {
    uint32_t Miss;
    uint64_t At;
  };
  std::vector<Promise> Open;
};

constexpr CacheShape Small{.Bytes = 4096,
                           .Ways = 4,
                           .Banks = 2,
                           .Mshrs = 2,
                           .HitCycles = 10,
                           .Hint = false};

TEST(Cache, AMissGoesDownAndAHitDoesNot) {
  Slow Below;
  Cache C(Small, Below);
  EXPECT_EQ(C.access({.Now = 100, .Address = 0}), 100 + 10 + Slow::Latency);
  EXPECT_EQ(C.access({.Now = 5000, .Address = 60}), 5010U);
  EXPECT_EQ(C.time().Reads, 2U);
  EXPECT_EQ(C.time().Hits, 1U);
  EXPECT_EQ(Below.Fetches, 1U);
}

TEST(Cache, ASecondMissOfALineWaitsForTheFirst) {
  Slow Below;
  Cache C(Small, Below);
  const uint64_t First = *C.access({.Now = 0, .Address = 0});
  EXPECT_EQ(C.access({.Now = 50, .Address = 4}), First + 10 - 5);
  EXPECT_EQ(C.time().Merged, 1U);
  EXPECT_EQ(Below.Fetches, 1U);
}

TEST(Cache, ABankWorksARequestACycle) {
  Slow Below;
  Cache C(Small, Below);
  C.access({.Now = 0, .Address = 0});
  C.access({.Now = 0, .Address = Line});
  // Lines 0 and 2 share a bank, line 1 has the other.
  C.access({.Now = 9000, .Address = 0});
  EXPECT_EQ(C.access({.Now = 9000, .Address = Line}), 9010U);
  EXPECT_EQ(C.access({.Now = 9000, .Address = 0}), 9011U);
  EXPECT_EQ(C.time().BankCycles, 1U);
}

TEST(Cache, MissesWaitForAnMshr) {
  Slow Below;
  Cache C(Small, Below);
  // Three misses of one bank, which has two MSHRs.
  C.access({.Now = 0, .Address = 0});
  C.access({.Now = 1, .Address = 2 * Line});
  const uint64_t Third = *C.access({.Now = 2, .Address = 4 * Line});
  // The first one's data are back at 5 + Latency.
  EXPECT_EQ(Third, 5 + Slow::Latency + 10 + Slow::Latency);
  EXPECT_EQ(C.time().MshrCycles, 5 + Slow::Latency - 2);
}

TEST(Cache, AStoreOfAWholeLineFetchesNothing) {
  Slow Below;
  Cache C(Small, Below);
  EXPECT_EQ(C.access({.Now = 0, .Address = 0, .Op = CacheOp::WriteWhole}), 5U);
  EXPECT_EQ(Below.Fetches, 0U);
  C.access({.Now = 0, .Address = Line, .Op = CacheOp::Write});
  EXPECT_EQ(Below.Fetches, 1U);
  EXPECT_EQ(C.flush(10000), 10001U);
  EXPECT_EQ(Below.Written, (std::vector<uint32_t>{0, Line}));
  EXPECT_EQ(C.time().Writes, 2U);
  EXPECT_EQ(C.time().Writebacks, 2U);
}

TEST(Cache, ABankIsBusyWhileItWorksOrWaitsForAnMshr) {
  struct Busy final : TimeObserver {
    void bankBusy(BankPlace Where, CycleSpan When) override {
      EXPECT_EQ(Where.Slice, 3U);
      Cycles[Where.Bank] += When.Until - When.From;
    }
    std::array<uint64_t, 2> Cycles{};
  } Seen;
  const TimeWatch Told({&Seen});
  const MemoryWatch Watch(Told, nullptr);
  Slow Below;
  Cache C(Small, Below);
  C.watch(&Watch, {.Slice = 3});
  C.access({.Now = 0, .Address = Line});
  C.access({.Now = 7, .Address = Line, .Op = CacheOp::Atomic, .Extra = 4});
  EXPECT_EQ(Seen.Cycles, (std::array<uint64_t, 2>{0, 1 + 5}));
  EXPECT_EQ(C.time().Atomics, 1U);
  // The third miss gets the first one's MSHR at 5 + Latency.
  for (const uint32_t N : {0, 2, 4})
    C.access({.Now = 20, .Address = N * Line});
  EXPECT_EQ(Seen.Cycles[0], 1 + 1 + (25 + Slow::Latency - 22 + 1));
}

TEST(Cache, TheHintSparesALineOnce) {
  CacheShape Shape = Small;
  Shape.Hint = true;
  Slow Below;
  Cache C(Shape, Below);
  const uint32_t Set = Small.Bytes / Small.Ways; // bytes between a set's lines
  C.access({.Now = 0, .Address = 0, .Keep = true});
  for (uint32_t N = 1; N != 5; ++N)
    C.access({.Now = 0, .Address = N * Set});
  EXPECT_EQ(C.time().Kept, 1U);
  EXPECT_EQ(C.access({.Now = 100000, .Address = 0}), 100010U) << "still there";
  // Nobody came for the line since it was spared, and the others are newer.
  C.clearCounters();
  for (uint32_t N = 5; N != 9; ++N)
    C.access({.Now = 200000, .Address = N * Set});
  EXPECT_EQ(C.time().Kept, 0U);
  C.access({.Now = 300000, .Address = 0});
  EXPECT_EQ(C.time().Hits, 0U);
}

// An answer that comes later is the one that would have come at once.
TEST(Cache, WhatIsDecidedLaterIsTheSame) {
  std::vector<CacheRequest> Asked;
  uint64_t Now = 0;
  for (uint32_t N = 0; N != 3000; ++N)
    Asked.push_back({.Now = Now += N % 5,
                     .Address = N / 2 * 7919 % 333 * Line,
                     .Op = N % 4 == 0   ? CacheOp::Write
                           : N % 7 == 0 ? CacheOp::WriteWhole
                           : N % 9 == 0 ? CacheOp::Atomic
                                        : CacheOp::Read,
                     .Extra = N % 9 == 0 ? 3U : 0U,
                     .From = {1, N}});
  CacheShape Shape = Small;
  Shape.Banks = 1; // so that there is one order of all
  Slow Below;
  Cache C(Shape, Below);
  std::vector<uint64_t> Expected, Then(Asked.size());
  for (const CacheRequest &R : Asked)
    Expected.push_back(*C.access(R));

  Slow Later;
  Later.IsOpen = true;
  Cache D(Shape, Later);
  unsigned Waited = 0;
  std::vector<Answer> Answers;
  for (const CacheRequest &R : Asked)
    if (const auto At = D.access(R))
      Then[R.From.Tag] = *At;
    else
      ++Waited;
  for (size_t N = 0; N != Later.Open.size(); ++N) {
    const Slow::Promise P = Later.Open[N];
    D.fill(P.Miss, P.At, Answers);
  }
  EXPECT_EQ(Answers.size(), Waited);
  for (const Answer &A : Answers) {
    EXPECT_EQ(A.To.Unit, 1U);
    EXPECT_EQ(Then[A.To.Tag], 0U) << "answered twice";
    Then[A.To.Tag] = A.At;
  }
  EXPECT_EQ(Then, Expected);
  EXPECT_GT(D.time().Merged, 0U);
  EXPECT_GT(D.time().MshrCycles, 0U);
  EXPECT_EQ(D.time().MshrCycles, C.time().MshrCycles);
  EXPECT_EQ(D.time().BankCycles, C.time().BankCycles);
  EXPECT_EQ(Later.Written, Below.Written);
}

/// Sets of at most so many lines, the most recently used in front.
class Naive {
public:
  struct Entry {
    uint32_t Line;
    bool Dirty;
  };
  /// Whether it hits.
  bool access(uint32_t Number, bool IsWrite) {
    std::list<Entry> &Set = Sets[Number % Sets.size()];
    for (auto E = Set.begin(); E != Set.end(); ++E)
      if (E->Line == Number) {
        Set.splice(Set.begin(), Set, E);
        Set.front().Dirty |= IsWrite;
        return true;
      }
    if (Set.size() == Small.Ways) {
      if (Set.back().Dirty)
        Written.push_back(Set.back().Line * Line);
      Set.pop_back();
    }
    Set.push_front({Number, IsWrite});
    return false;
  }
  std::vector<uint32_t> Written;

private:
  std::vector<std::list<Entry>> Sets{Small.Bytes / Line / Small.Ways};
};

RC_GTEST_PROP(Cache, HitsAndWritesBackLikeTheNaiveModel,
              (const std::vector<uint16_t> &Steps)) {
  Slow Below;
  Cache C(Small, Below);
  Naive Model;
  uint64_t Hits = 0, Now = 0;
  for (const uint16_t Step : Steps) {
    const uint32_t Number = Step / 2 % 200;
    const bool IsWrite = Step % 2;
    Hits += Model.access(Number, IsWrite);
    // Far apart, so that a line is there when it is wanted again.
    C.access({.Now = Now += 10000,
              .Address = Number * Line,
              .Op = IsWrite ? CacheOp::Write : CacheOp::Read});
  }
  RC_ASSERT(C.time().Hits == Hits);
  RC_ASSERT(C.time().Merged == 0U);
  RC_ASSERT(Below.Written == Model.Written);
}

/// Whatever the order and distance of requests, an answer never comes before
/// its request plus the hit time, and the bank's share of time adds up.
RC_GTEST_PROP(Cache, NothingIsAnsweredBeforeItCanBe,
              (const std::vector<std::pair<uint16_t, uint8_t>> &Steps)) {
  Slow Below;
  Cache C(Small, Below);
  uint64_t Now = 0;
  for (const auto &[Step, Gap] : Steps) {
    Now += Gap;
    const uint32_t Address = Step / 2 % 500 * Line;
    const bool IsWrite = Step % 2;
    const uint64_t Then =
        *C.access({.Now = Now,
                   .Address = Address,
                   .Op = IsWrite ? CacheOp::Write : CacheOp::Read});
    RC_ASSERT(Then >= Now + (IsWrite ? Small.HitCycles / 2 : Small.HitCycles));
  }
  const CacheTime &T = C.time();
  RC_ASSERT(T.Reads + T.Writes == Steps.size());
  RC_ASSERT(T.Hits + T.Merged + Below.Fetches == Steps.size());
}

} // namespace
