#include "view/Picked.h"

#include "lens/Models.h"

#include <cmath>
#include <gtest/gtest.h>

using namespace vorion::splat;

namespace {

/// Gaussians at these points.
Scene sceneAt(const std::vector<std::array<double, 3>> &Points) {
  Scene S = Scene::sized(Points.size(), 0);
  for (std::size_t I = 0; I != Points.size(); ++I)
    for (std::size_t A = 0; A != 3; ++A)
      S.setMean(3 * I + A, Points[I][A]);
  return S;
}

TEST(Picked, PartsFollowEachOther) {
  const Scene S = sceneAt({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {9, 0, 0}});
  EXPECT_EQ(selected(S, {}), Selection({false, false, false, false}));
  const PickedPart Box{true, std::array<double, 6>{0, -1, -1, 2, 1, 1}};
  EXPECT_EQ(selected(S, {Box}), Selection({true, true, true, false}))
      << "a corner belongs to its box";
  const PickedPart Sphere{false, std::array<double, 4>{1, 0, 0, 0.5}};
  EXPECT_EQ(selected(S, {Box, Sphere}), Selection({true, false, true, false}));
  EXPECT_EQ(selected(S, {Sphere, Box}), Selection({true, true, true, false}));
}

TEST(Picked, OpacityAndSizeAreActivated) {
  Scene S = sceneAt({{0, 0, 0}, {0, 0, 0}});
  S.OpacityLogits = {0, -5};
  S.LogScales = {0, -9, -9, std::log(0.1F), -9, -9};
  EXPECT_EQ(selected(S, {{true, Fainter{0.5}}}), Selection({false, true}));
  EXPECT_EQ(selected(S, {{true, Larger{0.5}}}), Selection({true, false}));
}

TEST(Picked, AStrokeTakesWhatIsUnderItAtAnyDepth) {
  const Scene S =
      sceneAt({{0, 0, 1}, {0, 0, 50}, {1, 0, 1}, {0, 0, -1}, {40, 0, 1}});
  Stroke Middle{Camera::ahead(64, 48, 16), 3, {{32, 24}}};
  EXPECT_EQ(selected(S, {{true, Middle}}),
            Selection({true, true, false, false, false}));
  const auto Places = placesOf(S, Selection(5, true), Middle.View, 10);
  ASSERT_EQ(Places.size(), 3U) << "neither behind nor outside";
  EXPECT_FLOAT_EQ(Places[2][0], 48.0F / 64);
  EXPECT_FLOAT_EQ(Places[2][1], 0.5F);
  EXPECT_EQ(placesOf(S, Selection(5, true), Middle.View, 2).size(), 2U);
}

TEST(Picked, APlaceIsWhereTheLensShowsIt) {
  for (const LensModel *Model :
       {&lenses::Fisheye, &lenses::Equirectangular, &lenses::Orthographic}) {
    Camera C = Camera::ahead(64, 48, 16);
    C.Optics.Model = Model;
    const auto Ray = C.Optics.direction(0.5, 0.25);
    ASSERT_TRUE(Ray);
    std::array<double, 3> Point{};
    for (std::size_t A = 0; A != 3; ++A)
      Point[A] = 3 * (*Ray)[A];
    if (Model->IsParallel)
      Point = {0.5, 0.25, 3};
    const auto Places = placesOf(sceneAt({Point}), {true}, C, 1);
    ASSERT_EQ(Places.size(), 1U) << Model->Name;
    EXPECT_NEAR(Places[0][0] * 64, 32 + 8, 1e-4) << Model->Name;
    EXPECT_NEAR(Places[0][1] * 48, 24 + 4, 1e-4) << Model->Name;
  }
}

TEST(Picked, ARequestSaysWhatIsWrongWithIt) {
  const auto R = parsePicked(R"({"do": "crop", "scene": 3, "parts": [
      {"op": "remove", "box": [0, 0, 0, 1, 1, 1]}, {"larger": 2}]})");
  ASSERT_TRUE(R) << R.error().What;
  EXPECT_EQ(R->Do, EditKind::Crop);
  EXPECT_EQ(R->Scene, 3U);
  ASSERT_EQ(R->Parts.size(), 2U);
  EXPECT_FALSE(R->Parts[0].IsAdded);
  for (const auto &[Text, Key] :
       {std::pair("[]", "parts"),
        {R"({"parts": 1})", "parts"},
        {R"({"parts": [{"orange": 1}]})", "parts"},
        {R"({"parts": [{"box": [1]}]})", "box"},
        {R"({"parts": [{"box": 1, "op": "paint"}]})", "op"},
        {R"({"parts": [{"sphere": [0, 0, 0, "wide"]}]})", "sphere"},
        {R"({"parts": [{"stroke": {"radius": 1, "points": []}}]})", "camera"},
        {R"({"do": "crop", "parts": []})", "scene"},
        {R"({"do": "burn", "scene": 1})", "do"}}) {
    const auto Refused = parsePicked(Text);
    ASSERT_FALSE(Refused) << Text;
    EXPECT_NE(Refused.error().What.find(Key), std::string::npos)
        << Refused.error().What;
  }
}

} // namespace
