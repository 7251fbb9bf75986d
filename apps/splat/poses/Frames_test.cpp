#include "poses/Frames.h"

#include <functional>
#include <gtest/gtest.h>
#include <vector>

namespace vorion::splat {
namespace {

/// A frame of stripes of \p Period pixels that are shifted by \p Shift, beside
/// a slope that moves with them.
FrameFacts striped(std::size_t Period, std::size_t Shift) {
  std::vector<std::byte> Grey(MeasuredPixels);
  for (std::size_t I = 0; I < Grey.size(); ++I) {
    const std::size_t X = I % MeasuredWidth + Shift;
    Grey[I] = std::byte(I / MeasuredWidth % 2 == 0
                            ? (X % Period < Period / 2 ? 255 : 0)
                            : X * 255 / 1000);
  }
  return factsOfFrame(Grey);
}

/// \p Count frames that move by \p Step, of which those with \p IsSharp have
/// fine stripes.
std::vector<FrameFacts>
moving(std::size_t Count, std::size_t Step,
       const std::function<bool(std::size_t)> &IsSharp) {
  std::vector<FrameFacts> Frames(Count);
  for (std::size_t I = 0; I < Count; ++I)
    Frames[I] = striped(IsSharp(I) ? 4 : 64, Step * I);
  return Frames;
}

TEST(FramesTest, FineStripesAreSharper) {
  EXPECT_GT(striped(4, 0).Sharpness, striped(64, 0).Sharpness);
}

TEST(FramesTest, TheSharpestOfEachSpanIsChosen) {
  const auto Frames = moving(40, 10, [](std::size_t I) { return I % 10 == 7; });
  const ChosenFrames Chosen = chooseFrames(Frames, 4);
  EXPECT_EQ(Chosen.Frames, (std::vector<std::size_t>{7, 17, 27, 37}));
  EXPECT_EQ(Chosen.Still, 0U);
}

TEST(FramesTest, NeighboursAreHalfASpanApart) {
  const auto Frames =
      moving(20, 10, [](std::size_t I) { return I == 9 || I == 10; });
  const ChosenFrames Chosen = chooseFrames(Frames, 2);
  ASSERT_EQ(Chosen.Frames.size(), 2U);
  EXPECT_EQ(Chosen.Frames[0], 9U);
  EXPECT_GE(Chosen.Frames[1], 14U);
}

TEST(FramesTest, AStillCameraGivesOneFrame) {
  const std::vector<FrameFacts> Frames(30, striped(8, 0));
  const ChosenFrames Chosen = chooseFrames(Frames, 5);
  EXPECT_EQ(Chosen.Frames.size(), 1U);
  EXPECT_EQ(Chosen.Still, 4U);
}

TEST(FramesTest, AShortVideoGivesAllItsFrames) {
  const auto Frames = moving(3, 50, [](std::size_t) { return true; });
  EXPECT_EQ(chooseFrames(Frames, 100).Frames.size(), 3U);
}

} // namespace
} // namespace vorion::splat
