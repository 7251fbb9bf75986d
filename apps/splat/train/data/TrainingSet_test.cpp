#include "train/data/TrainingSet.h"

#include "capture/CaptureTest.h"
#include "train/data/Baselines.h"
#include "train/data/ViewOrder.h"

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
  const auto Set = loadTrainingSet(*C, {.Downscale = 2});
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

TEST(TrainingSet, AViewShrinksWithAllThatItHas) {
  TrainView V{{}, {4, 2, {}}, {1, 1, 1, 1, 1, 1, 0, 1}, {}};
  V.Pose.Width = 4;
  V.Pose.Height = 2;
  V.Pose.Fx = V.Pose.Fy = 8;
  for (uint8_t I = 0; I < 8; ++I) {
    V.Picture.Rgb.insert(V.Picture.Rgb.end(), {I, 10, 20});
    V.Alpha.push_back(static_cast<uint8_t>(10 * I));
  }
  V.Depths = {{1, 0.5F}, {2, 0.25F}, {4, 2.0F}};
  const TrainView Half = shrunk(V, 2);
  EXPECT_EQ(Half.Pose.Width, 2);
  EXPECT_EQ(Half.Pose.Height, 1);
  EXPECT_EQ(Half.Pose.Fx, 4);
  // Pixels 0, 1, 4, 5 are the left one; the right one is masked.
  EXPECT_EQ(Half.Picture.Rgb, (std::vector<uint8_t>{3, 10, 20, 0, 0, 0}));
  EXPECT_EQ(Half.Counts, (std::vector<uint8_t>{1, 0}));
  EXPECT_EQ(Half.Alpha, (std::vector<uint8_t>{25, 45}));
  const std::vector<DepthPoint> Depths = {{0, 0.5F}, {0, 2.0F}};
  EXPECT_EQ(Half.Depths, Depths);
}

TEST(TrainingSet, MasksAndAlphaSayWhichPixelsCount) {
  Folder Files = colmapBinaryOf(sampleCapture());
  std::string Mask(192, '\xff'), Transparent;
  for (int P = 0; P < 48; ++P)
    Transparent += {'\x50', '\x60', '\x70', static_cast<char>(P < 4 ? 0 : 255)};
  for (int K = 0; K < 3; ++K)
    Mask[4 * 8 + K] = 0; // a black pixel: the first of the second row
  Files["masks/a1.png"] = pngOf(8, 6, Mask);
  Files["images/a2.png"] = pngOf(8, 6, Transparent);
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path(), {{}, false, MaskSource::Files});
  ASSERT_TRUE(C) << C.error().What;
  const auto Set =
      loadTrainingSet(*C, {.Masks = MaskSource::Files, .KeepAlpha = true});
  ASSERT_TRUE(Set) << Set.error().What;
  std::vector<uint8_t> Want(48, 1);
  Want[8] = 0;
  EXPECT_EQ(Set->Training[0].Counts, Want);
  EXPECT_EQ(Set->Training[0].Picture.Rgb[3 * 8 + 1], 0); // was 0x40
  EXPECT_TRUE(Set->Training[0].Alpha.empty());
  const TrainView &V = Set->Training[1];
  EXPECT_TRUE(V.Counts.empty());
  ASSERT_EQ(V.Alpha.size(), 48U);
  EXPECT_EQ(V.Picture.Rgb[0], 0);
  const Photo On = over(V, {0, 0, 0}, {1, 0.5F, 0});
  EXPECT_EQ(On.Rgb[0], 255);
  EXPECT_EQ(On.Rgb[1], 128);
  EXPECT_EQ(On.Rgb[2], 0);
  EXPECT_EQ(On.Rgb[3 * 4], 0x50);

  const auto ByAlpha = loadTrainingSet(*C, {.Masks = MaskSource::Alpha});
  ASSERT_TRUE(ByAlpha);
  EXPECT_TRUE(ByAlpha->Training[0].Counts.empty());
  EXPECT_EQ(std::ranges::count(ByAlpha->Training[1].Counts, 0), 4);

  Files["masks/a1.png"] = pngOf(2, 2, std::string(16, '\xff'));
  const CaptureFolder G(Files);
  const auto Small = loadTrainingSet(
      *readCapture(G.path(), {{}, false, MaskSource::Files}), {});
  ASSERT_FALSE(Small);
  EXPECT_EQ(Small.error().What, "2x2 pixels, expected 8x6 as in its picture");

  // The loss would be 0 over 0.
  std::string Black;
  for (int P = 0; P < 48; ++P)
    Black += {0, 0, 0, '\xff'};
  Files["masks/a1.png"] = pngOf(8, 6, Black);
  const CaptureFolder H(Files);
  const auto None = loadTrainingSet(
      *readCapture(H.path(), {{}, false, MaskSource::Files}), {});
  ASSERT_FALSE(None);
  EXPECT_NE(None.error().Where.find("masks/a1.png"), std::string::npos);
  EXPECT_EQ(None.error().What,
            "all pixels are masked out, expected at least one unmasked pixel");
}

TEST(TrainingSet, APictureOfALensIsUndistorted) {
  Folder Files = transformsOf(sampleCapture());
  std::string &Text = Files["transforms.json"];
  Text = replaced(Text, "\"k1\": 0", "\"k1\": 2");
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().What;
  EXPECT_EQ(C->distorted(), 10U);
  const auto Set = loadTrainingSet(*C, {});
  ASSERT_TRUE(Set);
  const TrainView &V = Set->Training[0];
  ASSERT_EQ(V.Counts.size(), 48U);
  EXPECT_EQ(V.Counts[0], 0); // from outside
  EXPECT_EQ(V.Counts[2 * 8 + 4], 1);
  EXPECT_EQ(V.Picture.Rgb[1], 0);
  EXPECT_EQ(V.Picture.Rgb[3 * (2 * 8 + 4) + 1], 0x40);
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
