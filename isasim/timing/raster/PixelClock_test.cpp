/// The pixel unit's time against closed formulas.
#include "timing/raster/PixelClock.h"

#include <gtest/gtest.h>
#include <numeric>

using namespace vorion::isasim;
using vorion::raster::TailWork;

namespace {

class PixelClockTest : public testing::Test {
protected:
  /// \p Pixels pixels that each examine all of \p Gaussians.
  static TailWork tail(unsigned Pixels, unsigned Gaussians) {
    TailWork W;
    W.Record = 0x100000;
    W.What.List = 0x110000;
    W.What.Output = 0x200000;
    W.What.OutputPitch = 1024;
    for (unsigned N = 0; N != Gaussians; ++N)
      W.Records.push_back(0x300000 + 64 * N);
    for (unsigned N = 0; N != Pixels; ++N)
      W.Pixels.push_back({static_cast<uint8_t>(N % 64),
                          static_cast<uint8_t>(N / 64), Gaussians});
    return W;
  }
  PixelTime timeOf(const TailWork &W) {
    PixelClock U(P, MemoryPort(), 1);
    U.begin(Now);
    TailWork Copy = W;
    U.expect(0, std::move(Copy));
    U.accept(0, Now);
    unsigned Served = 0;
    for (;;) {
      if (Memory.nextEvent() < U.turn().At) {
        std::vector<Answer> Answers;
        Memory.advance(U.turn().At, Answers);
        for (const Answer &A : Answers)
          U.answer(A);
        continue;
      }
      if (U.turn().At == Turn::Never)
        break;
      Served += U.step(Memory).has_value();
    }
    EXPECT_EQ(Served, 1U);
    const uint64_t End = U.freeAt();
    U.end(End);
    EXPECT_EQ(std::reduce(U.time().Cycles.begin(), U.time().Cycles.end()),
              End - Now)
        << "every cycle has one reason";
    Now = End + 100000;
    return U.time();
  }
  static uint64_t of(const PixelTime &T, PixelCycle C) {
    return T.Cycles[size_t(C)];
  }

  TimingConfig P;
  uint64_t Now = 0;
  MemorySystem Memory{P, 1};
};

TEST_F(PixelClockTest, LanesTakeAPixelEach) {
  for (const unsigned Pixels : {1U, 4U, 5U, 40U}) {
    const PixelTime T = timeOf(tail(Pixels, 50));
    EXPECT_EQ(of(T, PixelCycle::Evaluate), (Pixels + 3) / 4 * 50U) << Pixels;
    EXPECT_EQ(T.Visits, Pixels * 50U);
  }
}

TEST_F(PixelClockTest, TheLastPixelOfAGroupDecides) {
  TailWork W = tail(8, 60);
  for (unsigned N = 0; N != 8; ++N)
    W.Pixels[N].Visits = N < 4 ? 10 + N : 3;
  EXPECT_EQ(of(timeOf(W), PixelCycle::Evaluate), 13U + 3U);
}

TEST_F(PixelClockTest, WhatFitsTheBufferIsFetchedOnce) {
  timeOf(tail(64, 100)); // warms L2
  const auto Reads = [&](unsigned Entries) {
    P.Pixel.BufferEntries = Entries;
    Memory.begin(Now);
    timeOf(tail(64, 100));
    TimeReport R;
    Memory.report(R, Now);
    return R.L2[0].Reads;
  };
  // The record, 100 Gaussians with their list, 64 pixels; or 16 times over.
  EXPECT_NEAR(static_cast<double>(Reads(100)), 9 + 100 + 7 + 16, 2);
  EXPECT_NEAR(static_cast<double>(Reads(99)), 9 + 16 * 107 + 16, 2);
}

TEST_F(PixelClockTest, NothingOpenIsQuick) {
  const PixelTime T = timeOf(tail(0, 10));
  EXPECT_EQ(of(T, PixelCycle::Evaluate), 0U);
  EXPECT_EQ(T.Tails, 1U);
}

} // namespace
