#include "capture/Colmap.h"

#include "capture/CaptureTest.h"
#include "capture/ColmapRecords.h"
#include "lens/Models.h"

#include <algorithm>
#include <functional>
#include <limits>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

struct Parts {
  std::string Cameras, Images, Points;
};

Expected<ColmapModel> parsed(const Parts &P, bool Text) {
  const auto File = [](const char *Where, const std::string &Content) {
    return ColmapFile{Where, std::as_bytes(std::span(Content))};
  };
  const ColmapFiles Files{File("cameras", P.Cameras), File("images", P.Images),
                          File("points", P.Points)};
  return Text ? parseColmapText(Files) : parseColmapBinary(Files);
}

Parts partsOf(const SampleCapture &C, bool Text) {
  Folder F = Text ? colmapTextOf(C) : colmapBinaryOf(C);
  const std::string End = Text ? ".txt" : ".bin";
  return {F["sparse/0/cameras" + End], F["sparse/0/images" + End],
          F["sparse/0/points3D" + End]};
}

template <typename T> void patch(std::string &Text, std::size_t At, T Value) {
  Text.replace(At, sizeof(T), reinterpret_cast<const char *>(&Value),
               sizeof(T));
}

class Colmap : public ::testing::TestWithParam<bool> {};

TEST_P(Colmap, PointsAreThoseThatWereWritten) {
  const SampleCapture S = sampleCapture();
  const auto M = parsed(partsOf(S, GetParam()), GetParam());
  ASSERT_TRUE(M) << M.error().What;
  ASSERT_EQ(M->Points.size(), S.Points.size());
  for (std::size_t I = 0; I < S.Points.size(); ++I)
    for (std::size_t K = 0; K < 3; ++K) {
      EXPECT_EQ(M->Points.Positions[3 * I + K], S.Points[I].Position[K]);
      EXPECT_EQ(M->Points.Colours[3 * I + K], S.Points[I].Colour[K]);
    }
}

/// Of a track that names a picture twice, and one that is not there.
TEST_P(Colmap, PicturesKnowTheirPoints) {
  SampleCapture S = sampleCapture(3);
  S.Points.resize(3);
  S.Points[0].SeenBy = {2, 0};
  S.Points[1].SeenBy = {};
  S.Points[2].SeenBy = {2, 2};
  Parts P = partsOf(S, GetParam());
  auto M = parsed(P, GetParam());
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(M->Views[0].Sees, (std::vector<uint32_t>{0}));
  EXPECT_TRUE(M->Views[1].Sees.empty());
  EXPECT_EQ(M->Views[2].Sees, (std::vector<uint32_t>{0, 2}));
  if (!GetParam())
    return;
  P.Points = replaced(P.Points, " 0.5 102 0", " 0.5 7 0");
  M = parsed(P, true);
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(M->Views[2].Sees, (std::vector<uint32_t>{2}));
  // Files without a track, or without an error, are read.
  P.Points = replaced(P.Points, " 0.5 7 0 100 0", "");
  EXPECT_TRUE(parsed(P, true));
  P.Points = replaced(P.Points, " 0.5 102 0 102 0", " 0.5 102 0 102");
  EXPECT_FALSE(parsed(P, true));
}

TEST_P(Colmap, QuaternionsNeedNotBeExact) {
  SampleCapture S = sampleCapture(2);
  for (double &Q : S.Views[1].Quaternion)
    Q *= 1.0009;
  const auto M = parsed(partsOf(S, GetParam()), GetParam());
  ASSERT_TRUE(M);
  EXPECT_TRUE(isRotation(M->Views[1].Pose.Rotation));
}

TEST_P(Colmap, CountsOfNothingAreRefused) {
  SampleCapture S = sampleCapture();
  S.Points.clear();
  const auto NoPoints = parsed(partsOf(S, GetParam()), GetParam());
  ASSERT_TRUE(NoPoints);
  EXPECT_EQ(NoPoints->Points.size(), 0U);
  S = sampleCapture(0);
  const auto NoImage = parsed(partsOf(S, GetParam()), GetParam());
  ASSERT_FALSE(NoImage);
  EXPECT_EQ(NoImage.error().What, "no image, expected at least one");
}

TEST_P(Colmap, UnreadablePosesAreRefused) {
  for (const auto &[Q, T] :
       {std::pair(0.0, 0.0), {2.0, 0.0}, {1.0, 1.0 / 0.0}}) {
    SampleCapture S = sampleCapture();
    S.Views[2].Quaternion = {Q, 0, 0, 0};
    S.Views[2].Translation[1] = T;
    const auto M = parsed(partsOf(S, GetParam()), GetParam());
    ASSERT_FALSE(M);
    EXPECT_NE(M.error().What.find("image a2.png has an invalid pose"),
              std::string::npos)
        << M.error().What;
  }
}

TEST_P(Colmap, PointsAreFinite) {
  SampleCapture S = sampleCapture();
  S.Points[3].Position[1] = 1e300; // no float
  const auto M = parsed(partsOf(S, GetParam()), GetParam());
  ASSERT_FALSE(M);
  EXPECT_NE(M.error().What.find("point 3 has"), std::string::npos);
}

/// Whatever is cut off or overwritten, there is a model or one line.
TEST_P(Colmap, DamageIsReadOrRefused) {
  const Parts Whole = partsOf(sampleCapture(2), GetParam());
  unsigned Refused = 0, Tried = 0;
  for (std::string Parts::*Part :
       {&Parts::Cameras, &Parts::Images, &Parts::Points}) {
    const std::string &Text = Whole.*Part;
    const auto Try = [&](std::string Changed) {
      Parts P = Whole;
      P.*Part = std::move(Changed);
      const auto M = parsed(P, GetParam());
      ++Tried;
      if (M)
        return;
      ++Refused;
      EXPECT_EQ(M.error().Code, ExitCode::InputFile);
      const std::string Message = M.error().Where + M.error().What;
      EXPECT_TRUE(std::ranges::all_of(Message, [](char C) {
        return C >= ' ' && C <= '~';
      })) << Message;
    };
    for (std::size_t At = 0; At < Text.size(); ++At) {
      Try(Text.substr(0, At));
      for (const char Byte : {'\0', '\xff', '9'}) {
        std::string Changed = Text;
        Changed[At] = Byte;
        Try(Changed);
      }
    }
  }
  EXPECT_GT(Refused, Tried / 4);
}

INSTANTIATE_TEST_SUITE_P(Encodings, Colmap, ::testing::Bool(),
                         [](const auto &Info) {
                           return Info.param ? "Text" : "Binary";
                         });

/// Parameters in COLMAP's order (src/colmap/sensor/models.h).
TEST(ColmapText, LensesAreThoseOfTheirModels) {
  const struct {
    const char *Camera;
    double Fx, Fy, Cx, Cy;
    CameraModel Optics;
  } Cases[] = {
      {"SIMPLE_RADIAL 8 6 10 4 3 0.1", 10, 10, 4, 3, {&lenses::OpenCv, {0.1}}},
      {"RADIAL 8 6 10 4 3 0.1 0.2",
       10,
       10,
       4,
       3,
       {&lenses::OpenCv, {0.1, 0.2}}},
      {"OPENCV 8 6 10 11 4 3 0.1 0.2 0.3 0.4",
       10,
       11,
       4,
       3,
       {&lenses::OpenCv, {0.1, 0.2, 0.3, 0.4}}},
      {"FULL_OPENCV 8 6 10 11 4 3 0.1 0.2 0.3 0.4 0.5 0.6 0.7 0.8",
       10,
       11,
       4,
       3,
       {&lenses::OpenCv, {0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8}}},
      {"OPENCV_FISHEYE 8 6 10 11 4 3 0.1 0.2 0.3 0.4",
       10,
       11,
       4,
       3,
       {&lenses::Fisheye, {0.1, 0.2, 0.3, 0.4}}},
      {"SIMPLE_RADIAL_FISHEYE 8 6 10 4 3 0.1",
       10,
       10,
       4,
       3,
       {&lenses::Fisheye, {0.1}}},
      {"RADIAL_FISHEYE 8 6 10 4 3 0.1 0.2",
       10,
       10,
       4,
       3,
       {&lenses::Fisheye, {0.1, 0.2}}},
      {"SIMPLE_DIVISION 8 6 10 4 3 0.1",
       10,
       10,
       4,
       3,
       {&lenses::Division, {0.1}}},
      {"DIVISION 8 6 10 11 4 3 -0.1",
       10,
       11,
       4,
       3,
       {&lenses::Division, {-0.1}}},
      {"EUCM 8 6 10 11 4 3 0.5 1.5", 10, 11, 4, 3, {&lenses::Eucm, {0.5, 1.5}}},
      {"SIMPLE_FISHEYE 8 6 10 4 3", 10, 10, 4, 3, {&lenses::Fisheye}},
      {"FISHEYE 8 6 10 11 4 3", 10, 11, 4, 3, {&lenses::Fisheye}},
      {"EQUIRECTANGULAR 8 6 8 6",
       4 / M_PI,
       6 / M_PI,
       4,
       3,
       {&lenses::Equirectangular}},
      // Nothing bends.
      {"EUCM 8 6 10 11 4 3 0 0", 10, 11, 4, 3, {}},
      {"OPENCV 8 6 10 11 4 3 0 0 0 0", 10, 11, 4, 3, {}}};
  for (const auto &Case : Cases) {
    Parts P = partsOf(sampleCapture(2), true);
    P.Cameras = std::string("7 ") + Case.Camera + "\n";
    const auto M = parsed(P, true);
    ASSERT_TRUE(M) << Case.Camera << M.error().What;
    for (const CaptureView &V : M->Views) {
      EXPECT_EQ(V.Optics, Case.Optics) << Case.Camera;
      EXPECT_EQ(V.Pose.Fx, Case.Fx);
      EXPECT_EQ(V.Pose.Fy, Case.Fy);
      EXPECT_EQ(V.Pose.Cx, Case.Cx);
      EXPECT_EQ(V.Pose.Cy, Case.Cy);
    }
  }
}

/// Its parameters say again what the picture's size says.
TEST(ColmapText, ASphereIsAsLargeAsItsPictures) {
  Parts P = partsOf(sampleCapture(2), true);
  P.Cameras = "7 EQUIRECTANGULAR 8 6 8 5\n";
  const auto M = parsed(P, true);
  ASSERT_FALSE(M);
  EXPECT_EQ(M.error().What,
            "camera 7 has parameters 8 and 5, expected the width and the "
            "height of its pictures, 8 and 6");
}

/// Where COLMAP calls a camera bogus.
TEST(ColmapText, CoefficientsOfTheUnifiedModelHaveRanges) {
  for (const char *Wrong : {"-0.1 1", "1.1 1", "0.5 0", "0.5 -1", "0 -1"}) {
    Parts P = partsOf(sampleCapture(2), true);
    P.Cameras = std::string("7 EUCM 8 6 10 11 4 3 ") + Wrong + "\n";
    const auto M = parsed(P, true);
    ASSERT_FALSE(M) << Wrong;
    EXPECT_EQ(M.error().What,
              "camera 7 has coefficients of EUCM out of range, expected alpha "
              "from 0 to 1 and beta above 0");
  }
}

TEST(ColmapText, WhiteSpaceAroundLinesSaysNothing) {
  Parts P = partsOf(sampleCapture(2), true);
  for (std::string Parts::*Part :
       {&Parts::Cameras, &Parts::Images, &Parts::Points}) {
    std::string Spaced = "\xef\xbb\xbf \t# a comment\n \t\r\n";
    for (const char C : P.*Part)
      Spaced += C == '\n' ? " \t\r\n  " : std::string(1, C);
    P.*Part = std::move(Spaced);
  }
  P.Images = replaced(P.Images, "a1.png", "one more.png");
  const auto M = parsed(P, true);
  ASSERT_TRUE(M) << M.error().Where << ": " << M.error().What;
  ASSERT_EQ(M->Views.size(), 2U);
  EXPECT_EQ(M->Views[0].Pose.Name, "a0.png");
  EXPECT_EQ(M->Views[1].Pose.Name, "one more.png");
  EXPECT_EQ(M->Points.size(), sampleCapture(2).Points.size());
}

/// Numbers of COLMAP 4.
TEST(ColmapBinary, ModelsHaveColmapsNumbers) {
  for (const auto &[Id, Parameters, Lens] :
       {std::tuple(13, std::vector{10., 11., 4., 3., -0.1}, &lenses::Division),
        {16, {10., 11., 4., 3., 0.6, 1.2}, &lenses::Eucm},
        {17, {8., 6.}, &lenses::Equirectangular}}) {
    Parts P = partsOf(sampleCapture(2), false);
    std::string &File = P.Cameras;
    File.resize(8 + 4 + 4 + 8 + 8);
    patch<int32_t>(File, 12, Id);
    patch<uint64_t>(File, 16, 8);
    patch<uint64_t>(File, 24, 6);
    for (const double Value : Parameters)
      File.append(reinterpret_cast<const char *>(&Value), sizeof(Value));
    const auto M = parsed(P, false);
    ASSERT_TRUE(M) << M.error().What;
    EXPECT_EQ(M->Views[0].Optics.Model, Lens);
  }
}

// A model is added by its record alone: the row by which it was refused goes.
TEST(ColmapRecords, ARecordReplacesTheRefusedModelOfItsNumber) {
  static constexpr ColmapLens Rows[] = {{7, "FOV", 2, 1}};
  const LensModel Added{.Name = "FOV", .Colmap = Rows};
  const LensModel *const Lenses[] = {&lenses::Pinhole, &Added};
  const auto Models = colmapCameraModelsOf(Lenses);
  EXPECT_EQ(std::ranges::count(Models, 7, &ColmapCameraModel::Id), 1);
  EXPECT_EQ(std::ranges::find(Models, 7, &ColmapCameraModel::Id)->Lens, &Added);
  EXPECT_EQ(std::ranges::find(Models, 11, &ColmapCameraModel::Id)->Lens,
            nullptr);
}

TEST(ColmapBinary, AFileMayBeginAsAnotherKindDoes) {
  Parts P = partsOf(sampleCapture(2), false);
  // {" is where tensors (safetensors) have it.
  patch<int32_t>(P.Images, 8, 0x227b);
  const auto M = parsed(P, false);
  ASSERT_TRUE(M) << M.error().Where << ": " << M.error().What;
  EXPECT_EQ(M->Views.size(), 2U);
}

TEST(ColmapBinary, EachKindOfDamageHasItsMessage) {
  const Parts Whole = partsOf(sampleCapture(2), false);
  const struct {
    std::function<void(Parts &)> Change;
    const char *Message;
  } Cases[] = {
      {[](Parts &P) { patch<int32_t>(P.Cameras, 12, 11); },
       "cameras: camera 7 has the model RAD_TAN_THIN_PRISM_FISHEYE, expected "
       "one of SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL"},
      {[](Parts &P) { patch<int32_t>(P.Cameras, 12, 99); },
       "cameras: camera 7 has model number 99"},
      {[](Parts &P) { patch<uint64_t>(P.Cameras, 16, ~0ULL); },
       "expected sides of 1 to 16384"},
      {[](Parts &P) { patch<double>(P.Cameras, 32, -1); },
       "camera 7 has invalid parameters"},
      {[](Parts &P) { patch<uint64_t>(P.Cameras, 0, 2); },
       "cameras: truncated: the file ends in camera 1, expected 2 of them"},
      {[](Parts &P) { patch<uint64_t>(P.Points, 0, ~0ULL); },
       "points: truncated: the file ends in point 12"},
      {[](Parts &P) { P.Points += '\0'; },
       "points: 1 byte after the last record"},
      {[](Parts &P) { P.Images = std::string(4, '\1'); },
       "images: 4 bytes, expected the number of images first"},
      {[](Parts &P) { P.Images = "1234"; },
       "images: a text, expected the images of COLMAP in binary"},
      {[](Parts &P) { patch<int32_t>(P.Images, 68, 3); },
       "image a0.png has camera 3, expected one of the 1 cameras"},
      // The number of points that it sees.
      {[](Parts &P) { patch<uint64_t>(P.Images, 79, ~0ULL); },
       "images: truncated: the file ends in image 0"}};
  for (const auto &[Change, Message] : Cases) {
    Parts P = Whole;
    Change(P);
    const auto M = parsed(P, false);
    ASSERT_FALSE(M) << Message;
    const std::string Got = M.error().Where + ": " + M.error().What;
    EXPECT_NE(Got.find(Message), std::string::npos) << Got;
  }
}

TEST(ColmapText, EachKindOfDamageHasItsMessage) {
  const Parts Whole = partsOf(sampleCapture(2), true);
  const struct {
    std::string Parts::*Part;
    const char *What, *With, *Message;
  } Cases[] = {
      {&Parts::Cameras, "PINHOLE", "RAD_TAN_THIN_PRISM_FISHEYE",
       "cameras:2: camera 7 has the model RAD_TAN_THIN_PRISM_FISHEYE, expected "
       "one of SIMPLE_PINHOLE"},
      {&Parts::Cameras, "PINHOLE", "ORANGE",
       "cameras:2: camera 7 has model ORANGE"},
      {&Parts::Cameras, "PINHOLE", "SIMPLE_PINHOLE",
       "cameras:2: malformed line"},
      {&Parts::Cameras, "PINHOLE 8", "PINHOLE 8.5", "8.5x6 pixels"},
      {&Parts::Cameras, "7 PINHOLE", "seven PINHOLE",
       "expected CAMERA_ID MODEL"},
      {&Parts::Cameras, "\r\n", "\n7 PINHOLE 8 6 1 1 1 1",
       "cameras:3: duplicate camera 7"},
      {&Parts::Images, " 7 a0.png", " 7", "images:2: malformed line"},
      {&Parts::Images, " 7 a1.png", " 8 a1.png",
       "images:4: image a1.png has camera 8"},
      {&Parts::Images, "\n10 20 99 11 21 -1\n", "\n",
       "images:3: malformed line, expected X Y POINT3D_ID"},
      {&Parts::Images, "99 11", "hello 11", "images:3: malformed line"},
      {&Parts::Points, " 255 ", " 256 ", "points:2: malformed line"},
      {&Parts::Points, "5 0 0 -0", "5 0 nan -0", "point 0 has a NaN"}};
  for (const auto &[Part, What, With, Message] : Cases) {
    Parts P = Whole;
    P.*Part = replaced(P.*Part, What, With);
    const auto M = parsed(P, true);
    ASSERT_FALSE(M) << Message;
    const std::string Got = M.error().Where + ": " + M.error().What;
    EXPECT_NE(Got.find(Message), std::string::npos) << Got;
  }
}

} // namespace
