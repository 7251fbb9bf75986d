#include "io/Cameras.h"
#include "io/TestFiles.h"
#include "lens/Models.h"

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

TEST(Cameras, WhatIsNotHereIsRefusedByName) {
  const TestFolder Folder;
  const auto With = [&](const nlohmann::json &Keys) {
    auto R = record();
    R.update(Keys);
    return errorOf(Folder, nlohmann::json::array({R}).dump());
  };
  const auto Expect = [&](const nlohmann::json &Keys, const char *Message) {
    EXPECT_NE(With(Keys).find(Message), std::string::npos)
        << Keys << ": " << With(Keys);
  };
  EXPECT_EQ(With({{"skew", 0.5}}),
            "view front: key skew requires skewed pixels, which is not "
            "supported, expected the features in docs/cameras.md");
  Expect({{"distortion", {0, 0, 1e-3}}}, "lens distortion");
  Expect({{"distortion_params", {{"k1", 0.1}}}}, "lens distortion");
  Expect({{"rolling_shutter_time", 0.1}}, "a rolling shutter by velocities");
  Expect({{"rolling_shutter", "SIDEWAYS"}, {"rolling_turn", {0, 1, 0}}},
         "key rolling_shutter is invalid, expected start, across and down");
  Expect({{"rolling_shutter", {0, 0, 1e3}}}, "key rolling_shutter is invalid");
  Expect({{"rolling_shutter", {0, 0, 1}}, {"rolling_motion", {0, 0}}},
         "key rolling_motion is invalid, expected three numbers");
  Expect({{"rolling_shutter", {0, 0, 1}}, {"rolling_turn", {0, 1.2, 1.2}}},
         "key rolling_turn is invalid, expected an axis times an angle");
  Expect({{"rolling_turn", {0, 1, 0}}}, "need rolling_shutter");
  Expect({{"camera_model", "ORANGE"}},
         "key camera_model selects the camera model \"ORANGE\", which is not "
         "supported, expected PINHOLE, OPENCV");
  Expect({{"k4", 0.1}}, "is ambiguous between programs");
  Expect({{"k1", "x"}}, "key k1 is invalid, expected numbers from -1e+06");
  Expect({{"k1", 1e7}}, "key k1 is invalid");
  Expect({{"camera_model", "OPENCV_FISHEYE"}, {"p1", 0.1}},
         "key p1 sets the distortion coefficient p1, which the camera model "
         "OPENCV_FISHEYE does not have");
  Expect({{"camera_model", "ORTHOGRAPHIC"}, {"k1", 0.1}}, "expected 0");
  Expect({{"camera_model", "PINHOLE"}, {"is_fisheye", true}},
         "but the camera model is PINHOLE, expected consistent keys");
  Expect({{"camera_model", "OPENCV"}, {"is_fisheye", true}},
         "but the camera model is OPENCV, expected consistent keys");
  Expect({{"camera_model", "DIVISION"}, {"k1", 0.1}},
         "key k1 sets the distortion coefficient k1, which the camera model "
         "DIVISION does not have");
  Expect({{"camera_model", "eucm"}, {"alpha", 0.5}},
         "the coefficients of the camera model EUCM are out of range, expected "
         "alpha from 0 to 1 and beta above 0");
  Expect({{"camera_model", "EUCM"}, {"alpha", 1.5}, {"beta", 1}},
         "out of range");
  Expect({{"camera_model", "EUCM"}, {"dist_coeffs", {0.5, 1, 0}}},
         "at most 2 numbers");
  Expect({{"camera_model", "radial_fisheye"}, {"p1", 0.1}},
         "model RADIAL_FISHEYE does not have");
  Expect({{"camera_model", 3}}, "key camera_model is 3, expected a camera "
                                "model's name, PINHOLE, OPENCV");
  Expect({{"projection_type", {"fisheye"}}},
         "key projection_type is [\"fisheye\"], expected");
  Expect({{"is_fisheye", 1}}, "key is_fisheye is 1, expected true or false");
  Expect({{"lens_model", "ORANGE"}}, "key lens_model selects the camera model");
  Expect({{"camera_model", "OPENCV"}, {"camera_type", "equirectangular"}},
         "keys camera_model and camera_type select different camera models");
  Expect({{"dist_coeffs", std::vector<double>(13)}}, "at most 12 numbers");
  Expect({{"dist_coeffs", {1, nullptr}}}, "key dist_coeffs is invalid");
  for (const nlohmann::json &Nothing : std::initializer_list<nlohmann::json>{
           {{"k1", 0}},
           {{"distortion", {0, 0.0, -0.0, 0}}},
           {{"is_fisheye", false}},
           {{"camera_model", "SIMPLE_PINHOLE"}},
           {{"model", "OPENCV"}},
           {{"camera_model", "OPENCV"}, {"camera_type", "perspective"}},
           {{"camera_model", nullptr}, {"is_fisheye", nullptr}},
           {{"dist_coeffs", nlohmann::json::array()}},
           {{"comment", "k1"}}})
    EXPECT_EQ(With(Nothing), "") << Nothing;
}

TEST(Cameras, LensesAreReadByAllTheirNames) {
  const TestFolder Folder;
  const auto With = [&](const nlohmann::json &Keys) {
    auto R = record();
    R.update(Keys);
    const auto C = readCameras(
        Folder.write("lens.json", nlohmann::json::array({R}).dump()));
    EXPECT_TRUE(C) << Keys << ": " << C.error().What;
    return C ? C->front() : Camera();
  };
  const auto Expect = [&](const nlohmann::json &Keys, const LensModel *M,
                          const LensCoefficients &K) {
    const Camera C = With(Keys);
    EXPECT_EQ(C.Optics, (CameraModel{M, K})) << Keys;
    const std::string Path = Folder.write("again.json", "");
    EXPECT_TRUE(writeCameras(Path, {C}));
    const auto Again = readCameras(Path);
    ASSERT_TRUE(Again) << Again.error().What;
    EXPECT_EQ(Again->front(), C);
  };
  Expect({{"k1", 0.1}, {"k2", 0.2}, {"p1", 0.3}, {"p2", 0.4}, {"k3", 0.5}},
         &lenses::OpenCv, {0.1, 0.2, 0.3, 0.4, 0.5});
  Expect({{"camera_model", "SIMPLE_RADIAL"}, {"k1", 0.1}}, &lenses::OpenCv,
         {0.1});
  Expect({{"camera_model", "FULL_OPENCV"}, {"k4", 0.1}, {"k6", 0.2}, {"s4", 1}},
         &lenses::OpenCv, {0, 0, 0, 0, 0, 0.1, 0, 0.2, 0, 0, 0, 1});
  Expect({{"dist_coeffs", {1, 2, 3, 4, 5, 6, 7, 8}}}, &lenses::OpenCv,
         {1, 2, 3, 4, 5, 6, 7, 8});
  Expect({{"camera_model", "simple_division"}, {"k", -0.1}}, &lenses::Division,
         {-0.1});
  Expect({{"camera_model", "DIVISION"}, {"dist_coeffs", {0.2}}},
         &lenses::Division, {0.2});
  Expect({{"camera_model", "eucm"}, {"alpha", 0.5}, {"beta", 1.5}},
         &lenses::Eucm, {0.5, 1.5});
  Expect({{"camera_model", "EUCM"}, {"dist_coeffs", {1, 0.5}}}, &lenses::Eucm,
         {1, 0.5});
  Expect({{"camera_model", "OPENCV"}, {"k1", 0.1}, {"r8", 0.2}},
         &lenses::OpenCv, {0.1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0.2});
  Expect({{"camera_model", "pinhole"},
          {"radial_coeffs", {1, 2, 3, 4, 5, 6}},
          {"tangential_coeffs", {7, 8}},
          {"thin_prism_coeffs", {9, 10, 11, 12}}},
         &lenses::OpenCv, {1, 2, 7, 8, 3, 4, 5, 6, 9, 10, 11, 12});
  Expect({{"camera_model", "OPENCV_FISHEYE"}, {"k1", 1}, {"k4", 4}},
         &lenses::Fisheye, {1, 0, 0, 4});
  Expect({{"camera_model", "fisheye"}, {"radial_coeffs", {1, 2, 3, 4}}},
         &lenses::Fisheye, {1, 2, 3, 4});
  Expect({{"is_fisheye", true}}, &lenses::Fisheye, {});
  Expect({{"camera_model", "ORTHOPHOTO"}}, &lenses::Orthographic, {});
  Expect({{"camera_type", "equirectangular"}}, &lenses::Equirectangular, {});
  const Camera Sphere = With({{"camera_model", "EQUIRECTANGULAR"}});
  EXPECT_EQ(Sphere.Fx, Sphere.Width / (2 * M_PI));
  EXPECT_EQ(Sphere.Cy, 0.5 * Sphere.Height);
}

TEST(Cameras, WrongValuesAreNamed) {
  const TestFolder Folder;
  const auto Expect = [&](const char *Key, const nlohmann::json &Value) {
    auto R = record();
    R[Key] = Value;
    const auto What = errorOf(Folder, nlohmann::json::array({R}).dump());
    EXPECT_TRUE(What.find(fmt::format("key {} is invalid, expected", Key)) !=
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

TEST(Cameras, AViewThatSeveralMayBeSaysWhich) {
  const TestFolder Folder;
  auto List = nlohmann::json::array();
  for (const char *Name : {"left/1.jpg", "right/1.jpg", "2.png", "2.png"}) {
    List.push_back(record());
    List.back()["img_name"] = Name;
    List.back()["id"] = List.size() + 1;
  }
  const std::string File = Folder.write("c.json", List.dump());
  const auto Of = [&](const std::string &View) {
    const auto C = readCamera(File, View);
    return C ? std::to_string(C->Id) : C.error().What;
  };
  EXPECT_EQ(Of("1"),
            "view 1 is ambiguous: left/1.jpg (number 2) or right/1.jpg (number "
            "3), expected a unique name or number");
  EXPECT_EQ(Of("2"), "view 2 is ambiguous: left/1.jpg (number 2) or 2.png "
                     "(number 4), expected a unique name or number");
  EXPECT_EQ(Of("2.png"), "view 2.png is ambiguous: 2.png (number 4) or 2.png "
                         "(number 5), expected a unique name or number");
  EXPECT_EQ(Of("right/1.jpg"), "3");
  EXPECT_EQ(Of("5"), "5");
}

TEST(Cameras, WhatIsNoCameraListIsAnError) {
  const TestFolder Folder;
  EXPECT_NE(errorOf(Folder, "").find("an empty file"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[{]").find("not JSON"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "{}").find("array of cameras"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[]").find("array of cameras"), std::string::npos);
  EXPECT_NE(errorOf(Folder, "[1]").find("record 0 is not an object"),
            std::string::npos);
  EXPECT_NE(errorOf(Folder, std::string(100000, '[')).find("deeper than 256"),
            std::string::npos);
  const std::string Good = nlohmann::json::array({record()}).dump();
  for (std::size_t Size = 0; Size < Good.size(); ++Size)
    EXPECT_NE(errorOf(Folder, Good.substr(0, Size)), "") << Size << " bytes";
}

} // namespace
