#include "train/TrainingSet.h"

#include "capture/CaptureTest.h"
#include "train/Baselines.h"
#include "train/ViewOrder.h"

#include <algorithm>
#include <cmath>
#include <set>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

TEST(TrainingSet, PicturesAndCamerasAreMadeSmallerTogether) {
  const CaptureFolder F(colmapBinaryOf(sampleCapture()));
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C);
  const auto Set = loadTrainingSet(*C, 2, {0, 0, 0});
  ASSERT_TRUE(Set) << Set.error().What;
  ASSERT_EQ(Set->Training.size(), 8U);
  ASSERT_EQ(Set->HeldOut.size(), 2U);
  const TrainView &V = Set->Training[0]; // a1.png
  EXPECT_EQ(V.Pose.Name, "a1.png");
  EXPECT_EQ(V.Picture.Width, 4);
  EXPECT_EQ(V.Pose.Width, 4);
  EXPECT_EQ(V.Pose.Height, 3);
  EXPECT_EQ(V.Pose.Fx, 5);
  // Red is 20, green 0x40, blue the pixel's number: 0, 1, 8, 9 here.
  EXPECT_EQ(V.Picture.Rgb[0], 20);
  EXPECT_EQ(V.Picture.Rgb[1], 0x40);
  EXPECT_NEAR(V.Picture.Rgb[2], 4.5, 0.5);
  EXPECT_EQ(Set->largest(), std::pair(4, 3));
}

TEST(ViewOrder, EveryRoundHasEveryView) {
  ViewOrder O(7, 3);
  std::vector<std::size_t> All;
  for (unsigned Round = 0; Round < 5; ++Round) {
    std::set<std::size_t> Seen;
    for (unsigned I = 1; I <= 7; ++I)
      Seen.insert(All.emplace_back(O.at(7 * Round + I)));
    EXPECT_EQ(Seen.size(), 7U);
    EXPECT_EQ(*Seen.rbegin(), 6U);
  }
  // Rounds differ, and so do seeds; whoever asks in between sees the same.
  EXPECT_FALSE(std::equal(All.begin(), All.begin() + 7, All.begin() + 7));
  ViewOrder Again(7, 3), Other(7, 4);
  for (const unsigned I : {35U, 20U, 1U, 9U})
    EXPECT_EQ(Again.at(I), All[I - 1]);
  unsigned Different = 0;
  for (unsigned I = 1; I <= 35; ++I)
    Different += Other.at(I) != All[I - 1];
  EXPECT_GT(Different, 10U);
}

TrainView viewOf(uint8_t Left, uint8_t Right) {
  TrainView V;
  V.Picture = {2, 1, {Left, Left, Left, Right, Right, Right}};
  return V;
}

TEST(Baselines, AreTheirDefinitions) {
  TrainingSet Set;
  Set.Training = {viewOf(0, 100), viewOf(40, 180)};
  Set.HeldOut = {viewOf(30, 150)};
  const auto B = baselinesOf(Set);
  ASSERT_TRUE(B);
  const auto Db = [](double A, double C) {
    return 10 * std::log10(255.0 * 255.0 * 2 / (A * A + C * C));
  };
  EXPECT_NEAR(B->Constant, Db(80 - 30, 80 - 150), 1e-9);
  EXPECT_NEAR(B->Mean, Db(20 - 30, 140 - 150), 1e-9);
  EXPECT_NEAR(B->BestView, Db(40 - 30, 180 - 150), 1e-9);
  Set.HeldOut.clear();
  EXPECT_FALSE(baselinesOf(Set));
}

} // namespace
