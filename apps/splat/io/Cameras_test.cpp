#include "io/Cameras.h"
#include "io/TestFiles.h"

#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;

namespace {

nlohmann::json record() {
  return {{"id", 7},
          {"img_name", "front"},
          {"width", 64},
          {"height", 48},
          {"position", {1.0, 2.0, 3.0}},
          {"rotation", {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}}},
          {"fx", 50.5},
          {"fy", 51.5}};
}

std::string errorOf(const TestFolder &Folder, const std::string &Text) {
  const auto C = readCameras(Folder.write("c.json", Text));
  return C ? "" : C.error().What;
}

TEST(Cameras, PrincipalPointDefaultsToTheCentre) {
  const TestFolder Folder;
  const auto C = readCamera(
      Folder.write("c.json", nlohmann::json::array({record()}).dump()),
      "front");
  ASSERT_TRUE(C) << C.error().What;
  EXPECT_EQ(C->Cx, 32);
  EXPECT_EQ(C->Cy, 24);
  EXPECT_EQ(C->Fx, 50.5);
  EXPECT_EQ(C->Id, 7);
}

TEST(Cameras, RotationIsCameraToWorld) {
  const TestFolder Folder;
  const auto C = readCamera(
      Folder.write("c.json", nlohmann::json::array({record()}).dump()), "7");
  ASSERT_TRUE(C) << C.error().What;
  // The camera's z axis is the third column: world x. A point two units along
  // it from the centre is at depth 2.
  const auto R = C->worldToCameraRotation();
  const auto T = C->worldToCameraTranslation();
  const double P[3] = {1 + 2, 2, 3};
  double Q[3];
  for (int I = 0; I < 3; ++I)
    Q[I] = R[3 * I] * P[0] + R[3 * I + 1] * P[1] + R[3 * I + 2] * P[2] + T[I];
  EXPECT_EQ(Q[0], 0);
  EXPECT_EQ(Q[1], 0);
  EXPECT_EQ(Q[2], 2);
}

TEST(Cameras, RoundTripsToTheSameDoubles) {
  const TestFolder Folder;
  Camera C;
  C.Id = 3;
  C.Name = "a view";
  C.Width = 17;
  C.Height = 9;
  C.Position = {0.1, -1e-17, 1.0 / 3};
  const double A = 0.7;
  C.Rotation = {{{std::cos(A), -std::sin(A), 0},
                 {std::sin(A), std::cos(A), 0},
                 {0, 0, 1}}};
  C.Fx = 1.0 / 7;
  C.Fy = 831.3843876;
  C.Cx = 8.123456789012345;
  C.Cy = -0.1;
  ASSERT_TRUE(writeCameras(Folder.path("c.json"), {C}));
  const auto R = readCamera(Folder.path("c.json"), "a view");
  ASSERT_TRUE(R) << R.error().What;
  EXPECT_EQ(R->Position, C.Position);
  EXPECT_EQ(R->Rotation, C.Rotation);
  EXPECT_EQ(R->Fx, C.Fx);
  EXPECT_EQ(R->Fy, C.Fy);
  EXPECT_EQ(R->Cx, C.Cx);
  EXPECT_EQ(R->Cy, C.Cy);
  EXPECT_EQ(R->Width, 17);
  EXPECT_EQ(R->Height, 9);
}

TEST(Cameras, EveryMissingKeyIsNamedWithItsView) {
  const TestFolder Folder;
  const std::pair<const char *, const char *> Wanted[] = {
      {"id", "an integer from 0 to 1073741824"},
      {"width", "an integer from 1 to "},
      {"height", "an integer from 1 to "},
      {"position", "three finite numbers a row"},
      {"rotation", "three rows of three finite numbers"},
      {"fx", "a finite number"},
      {"fy", "a finite number"}};
  for (const auto &[Key, Value] : Wanted) {
    auto R = record();
    R.erase(Key);
    EXPECT_TRUE(
        errorOf(Folder, nlohmann::json::array({R}).dump())
            .starts_with(fmt::format(
                "view front: key {} is missing, expected {}", Key, Value)))
        << Key;
  }
  auto R = record();
  R.erase("img_name");
  EXPECT_EQ(errorOf(Folder, nlohmann::json::array({record(), R}).dump()),
            "record 1: key img_name is missing, expected a string");
}

TEST(Cameras, WhatIsNoPinholeIsRefusedByName) {
  const TestFolder Folder;
  const auto With = [&](const char *Key, const nlohmann::json &Value) {
    auto R = record();
    R[Key] = Value;
    return errorOf(Folder, nlohmann::json::array({R}).dump());
  };
  EXPECT_EQ(With("k1", -1e-9),
            "view front: key k1 calls for lens distortion, which is not "
            "supported, expected a pinhole camera");
  EXPECT_NE(With("distortion", {0, 0, 1e-3}).find("lens distortion"),
            std::string::npos);
  EXPECT_NE(With("distortion_params", {{"k1", 0.1}}).find("lens distortion"),
            std::string::npos);
  EXPECT_NE(With("skew", 0.5).find("skewed pixels"), std::string::npos);
  EXPECT_NE(With("is_fisheye", true).find("key is_fisheye calls for"),
            std::string::npos);
  EXPECT_NE(With("camera_model", "EQUIRECTANGULAR")
                .find("key camera_model calls for the camera model "
                      "\"EQUIRECTANGULAR\", which is not supported"),
            std::string::npos);
  for (const auto &[Key, Value] :
       std::initializer_list<std::pair<const char *, nlohmann::json>>{
           {"k1", 0},
           {"distortion", {0, 0.0, -0.0, 0}},
           {"is_fisheye", false},
           {"camera_model", "SIMPLE_PINHOLE"},
           {"model", "OPENCV"},
           {"comment", "k1"}})
    EXPECT_EQ(With(Key, Value), "") << Key;
}

TEST(Cameras, WrongValuesAreNamed) {
  const TestFolder Folder;
  const auto Expect = [&](const char *Key, const nlohmann::json &Value) {
    auto R = record();
    R[Key] = Value;
    const auto What = errorOf(Folder, nlohmann::json::array({R}).dump());
    EXPECT_TRUE(What.find(fmt::format("key {} is wrong, expected", Key)) !=
                std::string::npos)
        << What << " for " << Key << " = " << Value.dump();
  };
  Expect("width", 0);
  Expect("width", 1.5);
  Expect("height", uint64_t(1) << 63);
  Expect("width", -3);
  Expect("id", "x");
  Expect("img_name", 4);
  Expect("fx", 0);
  Expect("fy", -1);
  Expect("fx", nullptr);
  Expect("cx", "left");
  Expect("position", {1, 2});
  Expect("position", {1, 2, "z"});
  Expect("rotation", 3);
  Expect("rotation", {{1, 0, 0}, {0, 1, 0}});
  Expect("rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0}});
  Expect("rotation", {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}}); // mirrored
  Expect("rotation", {{2, 0, 0}, {0, 2, 0}, {0, 0, 2}});  // scaled
}

TEST(Cameras, AnUnknownViewListsWhatThereIs) {
  const TestFolder Folder;
  auto Second = record();
  Second["img_name"] = "close";
  const auto C = readCamera(
      Folder.write("c.json", nlohmann::json::array({record(), Second}).dump()),
      "back");
  ASSERT_FALSE(C);
  EXPECT_EQ(C.error().What, "no view back, expected one of front, close");
}

TEST(Cameras, WhatIsNoCameraListIsAnError) {
  const TestFolder Folder;
  EXPECT_NE(errorOf(Folder, "").find("not JSON"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[{]").find("not JSON"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "{}").find("array of cameras"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[]").find("array of cameras"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[1]").find("record 0 is no object"),
            std::string::npos);
  EXPECT_NE(errorOf(Folder, std::string(100000, '[')).find("256 deep"),
            std::string::npos);
  const std::string Good = nlohmann::json::array({record()}).dump();
  for (std::size_t Size = 0; Size < Good.size(); ++Size)
    EXPECT_NE(errorOf(Folder, Good.substr(0, Size)), "") << Size << " bytes";
}

} // namespace
