#include "cameras/CameraPath.h"
#include "io/CameraLens.h"
#include "lens/Models.h"

#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <random>

using namespace vorion;
using namespace vorion::splat;
using Json = nlohmann::json;

namespace {

/// At (1, 2, 3), turned a quarter about y: it looks along -x.
const Json Rows = {0, 0, 1, 1, 0, 1, 0, 2, -1, 0, 0, 3, 0, 0, 0, 1};
const Json Columns = {0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 2, 3, 1};

Json sample() {
  return {{"camera_type", "perspective"},
          {"render_width", 64},
          {"render_height", 48},
          {"keyframes", {{{"matrix", Columns.dump()}, {"fov", 50}}}},
          {"camera_path",
           {{{"camera_to_world", Rows}, {"fov", 90}, {"aspect", 1.3}},
            {{"camera_to_world", Rows}, {"fov", 90}}}}};
}

void expectPose(const Camera &C) {
  EXPECT_EQ(C.Position, (std::array<double, 3>{1, 2, 3}));
  for (std::size_t R = 0; R < 3; ++R) {
    EXPECT_EQ(C.Rotation[R][2], R == 0 ? -1 : 0); // ahead
    EXPECT_EQ(C.Rotation[R][1], R == 1 ? -1 : 0); // down
  }
}

TEST(CameraPath, PosesAndFieldsOfViewAreThoseOfTheViewer) {
  const auto Read = parseCameraPath("file", sample());
  ASSERT_TRUE(Read) << Read.error().What;
  ASSERT_EQ(Read->size(), 2U);
  for (const Camera &C : *Read) {
    expectPose(C);
    EXPECT_NEAR(C.Fy, 24, 1e-12); // a vertical angle of 90 degrees
    EXPECT_EQ(C.Fx, C.Fy);
    EXPECT_EQ(C.Cx, 32);
    EXPECT_EQ(C.Cy, 24);
  }
  EXPECT_EQ((*Read)[1].Name, "00001");
}

TEST(CameraPath, KeyFramesStandForAPathThatWasNotGenerated) {
  for (const Json &Matrix : {Json(Columns.dump()), Columns, Rows}) {
    Json J = sample();
    J["camera_path"] = Json::array();
    J["keyframes"][0]["matrix"] = Matrix;
    const auto Read = parseCameraPath("file", J);
    ASSERT_TRUE(Read) << Read.error().What;
    ASSERT_EQ(Read->size(), 1U);
    expectPose(Read->front());
  }
}

TEST(CameraPath, AFisheyeHasThePixelsARadianOfThePinholesFocalLength) {
  Json J = sample();
  J["camera_type"] = "fisheye";
  const auto Read = parseCameraPath("file", J);
  ASSERT_TRUE(Read) << Read.error().What;
  for (const Camera &C : *Read) {
    expectPose(C);
    EXPECT_EQ(C.Optics, (CameraModel{&lenses::Fisheye, {}}));
    EXPECT_NEAR(C.Fx, 24, 1e-12);
    EXPECT_EQ(C.Fy, C.Fx);
    EXPECT_EQ(C.Cx, 32);
  }
}

TEST(CameraPath, ASphereNeedsNoFieldOfView) {
  Json J = sample();
  J["camera_type"] = "equirectangular";
  for (Json &One : J["camera_path"])
    One.erase("fov");
  const auto Read = parseCameraPath("file", J);
  ASSERT_TRUE(Read) << Read.error().What;
  Camera Sphere = Camera::ahead(64, 48, 1);
  setSphere(Sphere);
  for (const Camera &C : *Read) {
    expectPose(C);
    EXPECT_EQ(C.Optics, (CameraModel{&lenses::Equirectangular, {}}));
    EXPECT_EQ(C.Fx, Sphere.Fx);
    EXPECT_EQ(C.Fy, Sphere.Fy);
    EXPECT_EQ(C.Cy, Sphere.Cy);
  }
}

TEST(CameraPath, EachKindOfDamageHasItsMessage) {
  const struct {
    std::function<void(Json &)> Change;
    const char *Message;
  } Cases[] = {
      {[](Json &J) { J.erase("render_width"); }, "key render_width"},
      {[](Json &J) { J["render_height"] = 1e9; }, "key render_height"},
      {[](Json &J) { J["render_height"] = 4.5; }, "key render_height"},
      {[](Json &J) { J["camera_type"] = "vr180"; },
       "camera_type \"vr180\", expected \"perspective\", \"fisheye\" or "},
      {[](Json &J) { J["camera_type"] = 3; }, "camera_type 3"},
      {[](Json &J) {
         J["camera_path"] = 3;
         J["keyframes"] = Json::array();
       },
       "no camera in camera_path"},
      {[](Json &J) { J["camera_path"][1] = 3; }, "camera 00001: key camera_to"},
      {[](Json &J) { J["camera_path"][0]["camera_to_world"][3] = "x"; },
       "camera 00000: key camera_to_world is invalid, expected 16 numbers"},
      {[](Json &J) { J["camera_path"][0]["camera_to_world"][0] = 2; },
       "expected a rotation"},
      {[](Json &J) { J["camera_path"][0]["fov"] = 180; }, "key fov"},
      {[](Json &J) { J["camera_path"][0].erase("fov"); }, "key fov"},
  };
  for (const auto &[Change, Message] : Cases) {
    Json J = sample();
    Change(J);
    const auto Read = parseCameraPath("file", J);
    ASSERT_FALSE(Read) << Message;
    EXPECT_NE(Read.error().What.find(Message), std::string::npos)
        << Read.error().What;
  }
}

TEST(CameraPath, DamagedTextGivesWholeCamerasOrOneLine) {
  const std::string Whole = sample().dump();
  std::mt19937 Random(1);
  for (int N = 0; N < 3000; ++N) {
    std::string Text = Whole;
    for (int Left = 0; Left < 3; ++Left)
      Text[Random() % Text.size()] = Whole[Random() % Whole.size()];
    const Json J = Json::parse(Text, nullptr, false);
    if (!isCameraPath(J))
      continue;
    const auto Read = parseCameraPath("file", J);
    if (!Read) {
      EXPECT_EQ(Read.error().What.find('\n'), std::string::npos);
      continue;
    }
    for (const Camera &C : *Read) {
      EXPECT_TRUE(std::isfinite(C.Fx) && C.Fx > 0);
      EXPECT_TRUE(isRotation(C.Rotation));
    }
  }
}

} // namespace
