#include "capture/Transforms.h"

#include "capture/CaptureTest.h"
#include "lens/Models.h"

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Json = nlohmann::json;

Expected<TransformsFile> parsed(const std::string &Text) {
  return parseTransforms("file", std::as_bytes(std::span(Text)));
}

Json sample() {
  return Json::parse(transformsOf(sampleCapture(2))["transforms.json"]);
}

TEST(Transforms, FramesMayHaveTheirOwnCamera) {
  Json J = sample();
  J["frames"][1]["fl_x"] = 20;
  J["frames"][1]["w"] = 16;
  const auto T = parsed(J.dump());
  ASSERT_TRUE(T) << T.error().What;
  EXPECT_EQ(T->Views[0].Pose.Fx, 10);
  EXPECT_EQ(T->Views[1].Pose.Fx, 20);
  EXPECT_EQ(T->Views[1].Pose.Width, 16);
  EXPECT_EQ(T->Views[0].Pose.Name, "pictures/a0.png");
}

TEST(Transforms, EachAxisHasItsOwnFocalLength) {
  const auto Completed = [](const std::function<void(Json &)> &Change) {
    Json J = sample();
    for (const char *Key : {"fl_x", "fl_y", "cx", "cy", "w", "h"})
      J.erase(Key);
    Change(J);
    const auto T = parsed(J.dump());
    EXPECT_TRUE(T) << T.error().What;
    std::vector<Camera> Cameras;
    for (const TransformsView &V :
         T ? T->Views : std::vector<TransformsView>()) {
      EXPECT_FALSE(V.hasSize());
      Camera &C = Cameras.emplace_back(V.Pose);
      C.Width = 64;
      C.Height = 48;
      complete(C, V.Known);
    }
    Cameras.resize(2);
    return Cameras;
  };
  const double Right = M_PI / 2; // half of a side away
  const auto Angles = Completed([&](Json &J) {
    J["camera_angle_x"] = Right;
    J["camera_angle_y"] = Right;
    J["cx"] = 30;
  });
  EXPECT_NEAR(Angles[0].Fx, 32, 1e-12);
  EXPECT_NEAR(Angles[0].Fy, 24, 1e-12);
  EXPECT_EQ(Angles[0].Cx, 30);
  EXPECT_EQ(Angles[0].Cy, 24);
  const auto Mixed = Completed([&](Json &J) {
    J["camera_angle_x"] = Right;
    J["fl_y"] = 70;
    J["frames"][1]["x_fov"] = 90 / 1.5;
  });
  EXPECT_NEAR(Mixed[0].Fx, 32, 1e-12);
  EXPECT_EQ(Mixed[0].Fy, 70);
  EXPECT_NEAR(Mixed[1].Fx, 32 * std::sqrt(3), 1e-12);
  // The one axis that is known says both; a frame's goes before the file's.
  const auto One = Completed([&](Json &J) {
    J["fl_y"] = 50;
    J["frames"][1]["camera_angle_y"] = Right;
  });
  EXPECT_EQ(One[0].Fx, 50);
  EXPECT_NEAR(One[1].Fx, 24, 1e-12);
}

TEST(Transforms, ListsOfNamesSayWhatIsHeldOut) {
  Json J = sample();
  J["train_filenames"] = {"./pictures/a0.png"};
  J["test_filenames"] = {"./pictures/a1.png"};
  const auto T = parsed(J.dump());
  ASSERT_TRUE(T) << T.error().What;
  EXPECT_FALSE(T->Views[0].HeldOut);
  EXPECT_TRUE(T->Views[1].HeldOut);
  EXPECT_FALSE(parsed(sample().dump())->Views[1].HeldOut);
}

TEST(Transforms, NamesOfModelsAreInAnyCase) {
  Json J = sample();
  J["camera_model"] = "Perspective";
  EXPECT_TRUE(parsed(J.dump()));
  J["camera_model"] = "opencv_fisheye";
  const auto T = parsed(J.dump());
  ASSERT_TRUE(T);
  EXPECT_EQ(T->Views[0].Optics.Model, &lenses::Fisheye);
}

TEST(Transforms, LensesAreOfTheFileOrAFrame) {
  const auto LensesOf = [](const std::function<void(Json &)> &Change) {
    Json J = sample();
    Change(J);
    const auto T = parsed(J.dump());
    EXPECT_TRUE(T);
    return T ? std::pair(T->Views[0].Optics, T->Views[1].Optics)
             : std::pair(CameraModel(), CameraModel());
  };
  // Its k4 is of r^8.
  CameraModel Brown{&lenses::OpenCv, {0.1, 0.2, 0.5, 0.6, 0.3}};
  Brown.K[12] = 0.4;
  const auto Terms = [](Json &J) {
    J.update({{"k1", 0.1}, {"k2", 0.2}, {"k3", 0.3}, {"k4", 0.4}});
  };
  const auto [First, Second] = LensesOf([&](Json &J) {
    Terms(J);
    J["p1"] = 0.5;
    J["p2"] = 0.6;
    J["frames"][1]["k1"] = 0.7;
  });
  EXPECT_EQ(First, Brown);
  EXPECT_EQ(Second.K[0], 0.7);
  EXPECT_EQ(Second.K[1], 0.2);
  const CameraModel Fisheye{&lenses::Fisheye, {0.1, 0.2, 0.3, 0.4}};
  EXPECT_EQ(LensesOf([&](Json &J) {
              Terms(J);
              J.erase("camera_model");
              J["is_fisheye"] = true;
            }).first,
            Fisheye);
  EXPECT_EQ(LensesOf([&](Json &J) {
              Terms(J);
              J.erase("camera_model");
              J["camera_type"] = "fisheye";
            }).first,
            Fisheye);
  EXPECT_EQ(LensesOf([&](Json &J) {
              Terms(J);
              J["camera_model"] = "OPENCV_FISHEYE";
            }).first,
            Fisheye);
  const CameraModel Full{&lenses::OpenCv, {0.1, 0.2, 0, 0, 0.3, 0.4}};
  EXPECT_EQ(LensesOf([&](Json &J) {
              Terms(J);
              J["camera_model"] = "FULL_OPENCV";
            }).first,
            Full);
  EXPECT_TRUE(LensesOf([](Json &J) { J["k1"] = 0; }).first.isPinhole());
}

TEST(Transforms, ASphereNeedsNoFocalLength) {
  Json J = sample();
  J["camera_model"] = "EQUIRECTANGULAR";
  J.erase("fl_x");
  const auto T = parsed(J.dump());
  ASSERT_TRUE(T) << T.error().What;
  EXPECT_EQ(T->Views[0].Optics, (CameraModel{&lenses::Equirectangular, {}}));
  const Camera &C = T->Views[0].Pose;
  EXPECT_EQ(C.Fx, C.Width / (2 * M_PI));
  EXPECT_EQ(C.Cy, 0.5 * C.Height);
  J.erase("w");
  const auto NoSize = parsed(J.dump());
  ASSERT_FALSE(NoSize);
  EXPECT_NE(NoSize.error().What.find("key w is missing or invalid"),
            std::string::npos);
}

TEST(Transforms, EachKindOfDamageHasItsMessage) {
  const struct {
    std::function<void(Json &)> Change;
    const char *Message;
  } Cases[] = {
      {[](Json &J) { J = Json::array(); }, "expected an object with frames"},
      {[](Json &J) { J.erase("frames"); }, "no frames"},
      {[](Json &J) { J["frames"] = Json::array(); }, "no frames"},
      {[](Json &J) { J["frames"][1] = 3; }, "frame 1 has no file_path"},
      {[](Json &J) { J["frames"][1].erase("file_path"); },
       "frame 1 has no file_path"},
      {[](Json &J) { J["k1"] = "much"; },
       "frame pictures/a0.png: key k1 is invalid, expected numbers from -1e+06 "
       "to 1e+06"},
      {[](Json &J) { J["camera_model"] = "FISHEYE624"; },
       "frame pictures/a0.png: key camera_model selects the camera model "
       "\"FISHEYE624\", which is not supported, expected PINHOLE, OPENCV, "},
      {[](Json &J) { J["camera_model"] = 3; },
       "frame pictures/a0.png: key camera_model is 3, expected a camera "
       "model's name, PINHOLE, OPENCV, "},
      {[](Json &J) { J["frames"][1]["is_fisheye"] = 1; },
       "frame pictures/a1.png: key is_fisheye is 1, expected true or false"},
      {[](Json &J) { J["is_fisheye"] = "true"; },
       "key is_fisheye is \"true\", expected true or false"},
      {[](Json &J) { J["is_fisheye"] = true; },
       "key is_fisheye selects OPENCV_FISHEYE, but the camera model is"},
      {[](Json &J) { J["lens_model"] = "opencv_fisheye"; },
       "keys camera_model and lens_model select different camera models, "
       "expected one model"},
      {[](Json &J) { J["camera_type"] = "omnidirectional"; },
       "key camera_type selects the camera model \"omnidirectional\""},
      {[](Json &J) { J["camera_model"] = "ORTHOPHOTO"; },
       "a photograph of an orthographic camera, expected a pinhole"},
      {[](Json &J) { J["k5"] = 0.1; },
       "key k5 is ambiguous between programs, expected camera_model "
       "FULL_OPENCV, or 0"},
      {[](Json &J) { J["dist_coeffs"] = 0.1; }, "key dist_coeffs is invalid"},
      {[](Json &J) {
         J["camera_model"] = "EQUIRECTANGULAR";
         J["k1"] = 0.1;
       },
       "key k1 sets the distortion coefficient k1, which the camera model "
       "EQUIRECTANGULAR does not have"},
      {[](Json &J) {
         J["camera_model"] = "OPENCV_FISHEYE";
         J["p2"] = 0.1;
       },
       "key p2 sets the distortion coefficient p2, which the camera model "
       "OPENCV_FISHEYE does not have"},
      {[](Json &J) { J["frames"][1]["mask_path"] = 3; },
       "frame pictures/a1.png: key mask_path is invalid"},
      {[](Json &J) { J["frames"][1]["transform_matrix"][2] = 0; },
       "frame pictures/a1.png: an invalid pose"},
      {[](Json &J) { J["frames"][1]["transform_matrix"][0][0] = 2; },
       "an invalid pose"},
      {[](Json &J) { J["frames"][1]["transform_matrix"][0][3] = "x"; },
       "an invalid pose"},
      {[](Json &J) { J["frames"][0].erase("transform_matrix"); },
       "an invalid pose"},
      {[](Json &J) { J["rolling_shutter"] = {0, 0, "x"}; },
       "key rolling_shutter is invalid, expected start, across and down"},
      {[](Json &J) { J["rolling_shutter_time"] = 0.01; },
       "key rolling_shutter_time requires a rolling shutter by velocities, "
       "which is not supported"},
      {[](Json &J) { J["frames"][1]["rolling_shutter_time"] = 0.01; },
       "frame pictures/a1.png: key rolling_shutter_time requires"},
      {[](Json &J) { J["frames"][1]["transform_matrix_end"] = 1; },
       "an invalid pose, expected transform_matrix_end"},
      {[](Json &J) { J.erase("w"); }, "key w is missing or invalid"},
      {[](Json &J) { J["h"] = 6.5; }, "key h is missing or invalid"},
      {[](Json &J) { J["fl_y"] = -1; }, "a focal length that is not positive"},
      {[](Json &J) { J["cx"] = "left"; }, "key cx is invalid"},
      {[](Json &J) {
         J.erase("fl_x");
         J.erase("fl_y");
       },
       "no focal length"},
      {[](Json &J) {
         J.erase("fl_x");
         J["camera_angle_x"] = 4;
       },
       "key camera_angle_x is invalid, expected radians between 0 and pi"},
      {[](Json &J) { J["frames"][1]["x_fov"] = 180; },
       "key x_fov is invalid, expected degrees between 0 and 180"},
      {[](Json &J) { J["ftheta_p1"] = 1e-3; },
       "key ftheta_p1 requires an f-theta lens, which is not supported"},
      {[](Json &J) { J["latlong"] = true; }, "key latlong requires"},
      {[](Json &J) { J["frames"][0]["transform_matrix"][3][3] = 2; },
       "an invalid pose"},
      {[](Json &J) { J["test_filenames"] = {"pictures/a7.png"}; },
       "key val_filenames or test_filenames has pictures/a7.png, expected "
       "file_path of a frame"},
      {[](Json &J) { J["ply_file_path"] = 1; },
       "key ply_file_path is invalid"}};
  for (const auto &[Change, Message] : Cases) {
    Json J = sample();
    Change(J);
    const auto T = parsed(J.dump());
    ASSERT_FALSE(T) << Message;
    EXPECT_EQ(T.error().Where, "file");
    EXPECT_NE(T.error().What.find(Message), std::string::npos)
        << T.error().What;
  }
}

/// Camera to world as files have it, turned about y and moved along x.
Json turnedBy(double Angle, double X) {
  const double C = std::cos(Angle), S = std::sin(Angle);
  return {{C, 0, S, X}, {0, 1, 0, 0}, {-S, 0, C, 0}, {0, 0, 0, 1}};
}

TEST(Transforms, RollingShuttersGoFromAPoseToAPose) {
  Json J = sample();
  J["rolling_shutter"] = {0.1, 0, 0.8, 0.05};
  Json &Frame = J["frames"][0];
  Frame.erase("transform_matrix");
  Frame["transform_matrix_start"] = turnedBy(0, 1);
  Frame["transform_matrix_end"] = turnedBy(0.2, 2);
  const auto T = parsed(J.dump());
  ASSERT_TRUE(T) << T.error().What;
  const CaptureView &V = T->Views[0];
  ASSERT_TRUE(V.Optics.Shutter);
  EXPECT_EQ(V.Optics.Shutter->Start, 0.1);
  EXPECT_EQ(V.Optics.Shutter->Down, 0.8);
  // y is down in the camera's own axes.
  EXPECT_NEAR(V.Optics.Shutter->Turn[1], -0.2, 1e-15);
  EXPECT_NEAR(V.Optics.Shutter->Motion[0], std::cos(0.1), 1e-15);
  EXPECT_NEAR(V.Pose.Position[0], 1.5, 1e-15);
  EXPECT_NEAR(V.Pose.Rotation[0][0], std::cos(0.1), 1e-15);
  EXPECT_FALSE(T->Views[1].Optics.Shutter);

  // All of the picture at one moment is a pose.
  J["rolling_shutter"] = {1, 0, 0};
  const auto Last = parsed(J.dump());
  ASSERT_TRUE(Last) << Last.error().What;
  EXPECT_FALSE(Last->Views[0].Optics.Shutter);
  EXPECT_NEAR(Last->Views[0].Pose.Position[0], 2, 1e-15);
}

TEST(Transforms, DamageIsReadOrRefused) {
  const std::string Text = sample().dump();
  unsigned Refused = 0;
  for (std::size_t At = 0; At < Text.size(); ++At) {
    EXPECT_FALSE(parsed(Text.substr(0, At)));
    for (const char Byte : {'\0', '\xff', '9'}) {
      std::string Changed = Text;
      Changed[At] = Byte;
      const auto T = parsed(Changed);
      Refused += !T;
    }
  }
  EXPECT_GT(Refused, Text.size());
}

TEST(PointCloud, IsReadFromAPly) {
  std::string Ply = "ply\nformat binary_little_endian 1.0\n"
                    "element vertex 2\nproperty float x\nproperty float y\n"
                    "property float z\nproperty uchar red\n"
                    "property uchar green\nproperty uchar blue\nend_header\n";
  for (const float V : {1.0F, 2.0F, 3.0F}) // twice the same row
    Ply.append(reinterpret_cast<const char *>(&V), 4);
  Ply += "\x01\x02\xff";
  Ply += Ply.substr(Ply.size() - 15);
  const auto P = parsePointCloud("file", std::as_bytes(std::span(Ply)));
  ASSERT_TRUE(P) << P.error().What;
  EXPECT_EQ(P->size(), 2U);
  EXPECT_EQ(P->Positions, (std::vector<double>{1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(P->Colours, (std::vector<uint8_t>{1, 2, 255, 1, 2, 255}));
  const std::string NoRed = replaced(Ply, "uchar red", "uchar rot");
  const auto Grey = parsePointCloud("file", std::as_bytes(std::span(NoRed)));
  ASSERT_TRUE(Grey) << Grey.error().What;
  EXPECT_EQ(Grey->Colours, std::vector<uint8_t>(6, 128));
}

TEST(PointCloud, ColoursAreThoseOfAnyType) {
  const struct {
    const char *Properties, *Row;
    std::vector<uint8_t> Colours;
  } Cases[] = {
      {"float red\nproperty float green\nproperty float blue",
       "0 0.2 1",
       {0, 51, 255}},
      {"double red\nproperty double green\nproperty double blue",
       "0 128 255",
       {0, 128, 255}},
      {"ushort red\nproperty ushort green\nproperty ushort blue",
       "0 257 65535",
       {0, 1, 255}},
      {"uchar diffuse_red\nproperty uchar diffuse_green\nproperty uchar "
       "diffuse_blue",
       "1 2 3",
       {1, 2, 3}},
      {"uchar r\nproperty uchar g\nproperty uchar b", "1 2 3", {1, 2, 3}},
      {"float f_dc_0\nproperty float f_dc_1\nproperty float f_dc_2",
       "0 9 -9",
       {128, 255, 0}},
      {"float nx\nproperty float ny\nproperty float nz",
       "0 1 0",
       {128, 128, 128}},
  };
  for (const auto &[Properties, Row, Colours] : Cases) {
    const std::string Ply =
        std::string("ply\nformat ascii 1.0\nelement vertex 1\nproperty float "
                    "x\nproperty float y\nproperty float z\nproperty ") +
        Properties + "\nend_header\n1 2 3 " + Row + "\n";
    const auto P = parsePointCloud("file", std::as_bytes(std::span(Ply)));
    ASSERT_TRUE(P) << P.error().What;
    EXPECT_EQ(P->Colours, Colours) << Properties;
  }
}

} // namespace
