#include "lens/Models.h"
#include "mesh/Mesh.h"
#include "view/Request.h"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <nlohmann/json.hpp>

using namespace vorion::splat;

namespace {

nlohmann::json good() {
  return {{"camera",
           {{"width", 64},
            {"height", 48},
            {"fx", 50},
            {"fy", 51},
            {"position", {1, 2, 3}},
            {"rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}}},
          {"setting", "exp=table,tile=32"},
          {"layer", "cycles"},
          {"x", 63},
          {"y", 0}};
}

TEST(ViewRequest, SaysWhatThePageAsksFor) {
  const auto R = parseViewRequest(good().dump());
  ASSERT_TRUE(R) << R.error().What;
  EXPECT_EQ(R->View.Width, 64);
  EXPECT_EQ(R->View.Cx, 32);
  EXPECT_EQ(R->View.Fy, 51);
  EXPECT_EQ(R->View.Position[2], 3);
  EXPECT_EQ(R->Shown, Layer::Cycles);
  EXPECT_TRUE(R->Clock) << "cycles are the clock's";
  EXPECT_FALSE(R->Compare);
  EXPECT_EQ(R->X, 63);
  const RenderOptions O = optionsOf(*R, {});
  EXPECT_EQ(O.Exponential, ExpUnit::Table);
  EXPECT_EQ(O.Tile, 32U);
}

TEST(ViewRequest, ALensIsThatOfCamerasFiles) {
  auto Asked = good();
  Asked["camera"]["lens"] = {{"camera_model", "OPENCV_FISHEYE"}, {"k1", 0.1}};
  const auto R = parseViewRequest(Asked.dump());
  ASSERT_TRUE(R) << R.error().What;
  EXPECT_EQ(R->View.Optics.Model, &lenses::Fisheye);
  EXPECT_EQ(R->View.Optics.K[0], 0.1);
  EXPECT_EQ(optionsOf(*R, {}).Optics, &lenses::Fisheye);
  Asked["camera"]["lens"] = {{"camera_model", "EQUIRECTANGULAR"}};
  const auto Sphere = parseViewRequest(Asked.dump());
  ASSERT_TRUE(Sphere) << Sphere.error().What;
  EXPECT_DOUBLE_EQ(Sphere->View.Fy, 48 / M_PI);
  for (const nlohmann::json &Bad :
       {nlohmann::json("OPENCV"), nlohmann::json({{"camera_model", "ORANGE"}}),
        nlohmann::json({{"k1", 1e9}}), nlohmann::json({{"k1", "much"}})}) {
    Asked["camera"]["lens"] = Bad;
    const auto Refused = parseViewRequest(Asked.dump());
    ASSERT_FALSE(Refused) << Bad;
    EXPECT_NE(Refused.error().What.find("lens"), std::string::npos);
  }
}

TEST(ViewRequest, WhatIsWrongIsNamed) {
  const std::pair<const char *, nlohmann::json> Wrong[] = {
      {"/camera", nullptr},
      {"/camera/width", 0},
      {"/camera/width", MostViewed + 1},
      {"/camera/height", 1.5},
      {"/camera/height", "48"},
      {"/camera/fx", -1},
      {"/camera/fy", nullptr},
      {"/camera/position", {1, 2}},
      {"/camera/position", {1, 2, "3"}},
      {"/camera/rotation", {{1, 0, 0}, {0, 1, 0}}},
      {"/camera/rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}},
      {"/setting", "speed=high"},
      {"/setting", 3},
      {"/layer", "colour"},
      {"/layer", 1},
      {"/x", 64},
      {"/y", -1}};
  for (const auto &[Where, Value] : Wrong) {
    nlohmann::json Asked = good();
    Asked[nlohmann::json::json_pointer(Where)] = Value;
    const auto R = parseViewRequest(Asked.dump());
    ASSERT_FALSE(R) << Asked;
    const std::string Key =
        std::string(Where).substr(std::string(Where).rfind('/') + 1);
    EXPECT_NE(R.error().What.find(Key), std::string::npos) << R.error().What;
  }
  for (const char *Text : {"", "[]", "3", "{", "{}", "null"})
    EXPECT_FALSE(parseViewRequest(Text)) << Text;
}

TEST(ViewRequest, EveryKnobReachesTheOptions) {
  // A knob that is forgotten here would show the default's picture.
  for (const Knob &K : allKnobs()) {
    const auto Changed = Setting::parse(K.Name + "=" + K.Values[1]);
    ASSERT_TRUE(Changed);
    ViewRequest Asked;
    Asked.Chosen = *Changed;
    const RenderOptions A = optionsOf({}, {}), B = optionsOf(Asked, {});
    EXPECT_TRUE(
        A.Exponential != B.Exponential || A.Arithmetic != B.Arithmetic ||
        A.AlphaCutoff != B.AlphaCutoff || A.Cutoff != B.Cutoff ||
        A.Tile != B.Tile || A.Reach != B.Reach || A.ShLimit != B.ShLimit ||
        A.DepthBits != B.DepthBits || A.ZTiles != B.ZTiles ||
        A.PixelUnit.any() != B.PixelUnit.any() ||
        A.SkipSaturated != B.SkipSaturated ||
        A.SubpixelBits != B.SubpixelBits || A.MeshDepth != B.MeshDepth ||
        A.FilterBits != B.FilterBits)
        << K.Name;
  }
}

TEST(ViewRequest, DrawsAsTheSceneSays) {
  ShownScene S;
  S.File.DrawnAs = {true, 0.1, ""};
  S.Near = 0.02F;
  EXPECT_TRUE(optionsOf({}, S).Antialiased);
  EXPECT_EQ(optionsOf({}, S).Dilation, 0.1F);
  EXPECT_EQ(optionsOf({}, S).nearLimit(), 0.02F);
}

TEST(ViewRequest, IntegerDepthsNeedPerspective) {
  ShownScene S;
  S.Surface = std::make_shared<const Mesh>();
  ViewRequest R;
  R.Chosen = *Setting::parse("mesh-depth=unorm16");
  EXPECT_TRUE(checkMesh(R, S));
  R.View.Optics.Model = &lenses::Orthographic;
  const auto Checked = checkMesh(R, S);
  ASSERT_FALSE(Checked);
  EXPECT_EQ(Checked.error().What,
            "--mesh-depth unorm16 is of depths that fall with 1/z, expected "
            "fp32 with a camera of model ORTHOGRAPHIC");
}

} // namespace
