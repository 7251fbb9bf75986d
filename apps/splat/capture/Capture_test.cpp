#include "capture/Capture.h"

#include "capture/CaptureTest.h"

#include <algorithm>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

/// Where \p C sees world point \p P, in camera coordinates.
std::array<double, 3> seen(const Camera &C, std::array<double, 3> P) {
  const auto R = C.worldToCameraRotation();
  auto T = C.worldToCameraTranslation();
  for (std::size_t I = 0; I < 3; ++I)
    for (std::size_t K = 0; K < 3; ++K)
      T[I] += R[3 * I + K] * P[K];
  return T;
}

Folder folderOf(CaptureFormat F, const SampleCapture &C) {
  switch (F) {
  case CaptureFormat::ColmapText:
    return colmapTextOf(C);
  case CaptureFormat::ColmapBinary:
    return colmapBinaryOf(C);
  case CaptureFormat::NerfSynthetic:
    return nerfSyntheticOf(C);
  case CaptureFormat::Transforms:
    return transformsOf(C);
  }
  return {};
}

class Captures : public ::testing::TestWithParam<CaptureFormat> {};

TEST_P(Captures, FilesAreAllThatIsRead) {
  const CaptureFolder F(folderOf(GetParam(), sampleCapture()));
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().What;
  const std::vector<std::string> Files = captureFiles(F.path());
  for (const CaptureView &V : C->Views)
    EXPECT_EQ(std::ranges::count_if(Files,
                                    [&V](const std::string &File) {
                                      return std::filesystem::equivalent(
                                          File, V.Picture);
                                    }),
              1)
        << V.Picture;
  const bool IsColmap = GetParam() == CaptureFormat::ColmapText ||
                        GetParam() == CaptureFormat::ColmapBinary;
  const std::size_t Described = IsColmap ? 3
                                : GetParam() == CaptureFormat::NerfSynthetic
                                    ? 2
                                    : 1;
  EXPECT_EQ(Files.size(), C->Views.size() + Described);
}

/// In the sample all cameras look at the origin from 3 away, y down.
TEST_P(Captures, PosesAreThoseThatWereWritten) {
  const CaptureFolder F(folderOf(GetParam(), sampleCapture()));
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().Where << ": " << C.error().What;
  EXPECT_EQ(C->Format, GetParam());
  EXPECT_TRUE(isCapture(F.path()));
  ASSERT_EQ(C->Views.size(), 10U);
  for (std::size_t I = 0; I < 10; ++I) {
    const Camera &Pose = C->Views[I].Pose;
    const auto Origin = seen(Pose, {0, 0, 0});
    const auto Above = seen(Pose, {0, -1, 0});
    EXPECT_NEAR(Origin[0], 0, 1e-12);
    EXPECT_NEAR(Origin[1], 0, 1e-12);
    EXPECT_NEAR(Origin[2], 3, 1e-12);
    EXPECT_NEAR(Above[1], -1, 1e-12);
    // The second camera is turned by 36 degrees: x of the world to its right.
    const auto Right = seen(Pose, {1, 0, 0});
    const double Angle = 2 * 3.14159265358979 * double(I) / 10;
    EXPECT_NEAR(Right[0], std::cos(Angle), 1e-12);
    EXPECT_NEAR(Right[2], 3 - std::sin(Angle), 1e-12);
    EXPECT_EQ(Pose.Width, 8);
    EXPECT_EQ(Pose.Height, 6);
  }
  const Camera &Pose = C->Views[0].Pose;
  if (GetParam() == CaptureFormat::NerfSynthetic) {
    EXPECT_NEAR(Pose.Fx, 4 / std::tan(0.4), 1e-12);
    EXPECT_EQ(Pose.Fx, Pose.Fy);
    EXPECT_EQ(Pose.Cx, 4);
  } else {
    EXPECT_EQ(Pose.Fx, 10);
    EXPECT_EQ(Pose.Fy, 11);
    EXPECT_EQ(Pose.Cx, 4.25);
    EXPECT_EQ(Pose.Cy, 3);
  }
}

TEST_P(Captures, EveryEighthIsHeldOutUnlessTheFileSays) {
  const CaptureFolder F(folderOf(GetParam(), sampleCapture()));
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C);
  std::vector<std::size_t> HeldOut;
  for (std::size_t I = 0; I < C->Views.size(); ++I)
    if (C->Views[I].HeldOut)
      HeldOut.push_back(I);
  EXPECT_EQ(HeldOut, GetParam() == CaptureFormat::NerfSynthetic
                         ? (std::vector<std::size_t>{8, 9})
                         : (std::vector<std::size_t>{0, 8}));
  EXPECT_EQ(C->heldOut(), 2U);
}

TEST_P(Captures, ExcludedPicturesAreLeftOutFirst) {
  const CaptureFolder F(folderOf(GetParam(), sampleCapture()));
  const auto C = readCapture(F.path(), {.Exclude = {"a0.png", "a4"}});
  ASSERT_TRUE(C);
  EXPECT_EQ(C->Views.size(), 8U);
  const auto Unknown = readCapture(F.path(), {.Exclude = {"a77"}});
  ASSERT_FALSE(Unknown);
  EXPECT_EQ(Unknown.error().Code, ExitCode::Usage);
  EXPECT_NE(Unknown.error().What.find("no picture a77 to exclude"),
            std::string::npos);
}

TEST_P(Captures, ViewsWithoutAPictureAreLeftOutAndCounted) {
  Folder Files = folderOf(GetParam(), sampleCapture());
  const auto Erase = [&](const char *Ending) {
    const auto Picture = std::ranges::find_if(
        Files, [&](const auto &F) { return F.first.ends_with(Ending); });
    ASSERT_NE(Picture, Files.end());
    Files.erase(Picture);
  };
  Erase("a0.png");
  Erase("a4.png");
  {
    const CaptureFolder F(Files);
    const auto C = readCapture(F.path());
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->WithoutPicture, 2U);
    EXPECT_EQ(C->Views.size(), 8U);
    // Every 8th of those that are left.
    EXPECT_TRUE(GetParam() == CaptureFormat::NerfSynthetic ||
                C->Views[0].HeldOut);
  }
  std::erase_if(Files, [](const auto &F) { return F.first.ends_with(".png"); });
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path());
  ASSERT_FALSE(C);
  EXPECT_NE(C.error().What.find("no such picture, nor any other"),
            std::string::npos)
      << C.error().What;
}

TEST(Capture, OnlyPosesAreReadOfAModelWithoutPictures) {
  Folder Undistorted;
  for (const auto &[Name, Content] : colmapTextOf(sampleCapture())) {
    if (Name.starts_with("images/"))
      Undistorted["dense/" + Name] = Content;
    else
      Undistorted[Name] = Undistorted["dense/" + Name] = Content;
  }
  const CaptureFolder F(Undistorted);
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().What;
  ASSERT_FALSE(C->Notes.empty());
  EXPECT_EQ(C->Notes.front(), "the model dense/sparse/0");
  const auto Poses = readCaptureCameras(F.path(), LensOf::Undistorted);
  ASSERT_TRUE(Poses) << Poses.error().What;
  ASSERT_FALSE(Poses->Files.empty());
  EXPECT_EQ(Poses->Files.front(), F.path("sparse/0/cameras.txt"));
}

TEST(Capture, MasksAreFoundByNameOrByPath) {
  const std::string Png = pngOf(8, 6, std::string(192, '\x7f'));
  const CaptureOptions Files{{}, false, MaskSource::Files};
  Folder Colmap = colmapTextOf(sampleCapture());
  {
    const CaptureFolder F(Colmap);
    const auto C = readCapture(F.path(), Files);
    ASSERT_FALSE(C);
    EXPECT_NE(C.error().What.find("no masks, expected masks/NAME.png"),
              std::string::npos);
  }
  Colmap["masks/a1.png.png"] = Png; // as COLMAP names it
  Colmap["masks/a2.png"] = Png;
  {
    const CaptureFolder F(Colmap);
    const auto C = readCapture(F.path(), Files);
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->masked(), 2U);
    EXPECT_EQ(C->Views[1].Mask, F.path("masks/a1.png.png"));
    EXPECT_EQ(C->Views[2].Mask, F.path("masks/a2.png"));
    EXPECT_EQ(readCapture(F.path())->masked(), 0U);
  }
  // The model's name of a picture may be another than its file's.
  Colmap["images/a1.jpg"] = std::move(Colmap["images/a1.png"]);
  Colmap.erase("images/a1.png");
  {
    const CaptureFolder F(Colmap);
    const auto C = readCapture(F.path(), Files);
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->Views[1].Mask, F.path("masks/a1.png.png"));
  }
  Folder Transforms = transformsOf(sampleCapture());
  Transforms["masks/a1.png"] = Png;
  Transforms["other/m.png"] = Png;
  std::string &Text = Transforms["transforms.json"];
  const std::size_t At = Text.find("\"file_path\"");
  ASSERT_NE(At, std::string::npos);
  Text.insert(At, "\"mask_path\": \"other/m.png\", ");
  {
    const CaptureFolder F(Transforms);
    const auto C = readCapture(F.path(), Files);
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->masked(), 2U);
    EXPECT_EQ(C->Views[0].Mask, F.path("other/m.png"));
  }
  Text = replaced(Text, "other/m.png", "../m.png");
  const CaptureFolder F(Transforms);
  const auto C = readCapture(F.path(), Files);
  ASSERT_FALSE(C);
  EXPECT_NE(C.error().What.find("expected a file inside the folder"),
            std::string::npos);
}

/// The first picture of another size, and no picture at all.
TEST_P(Captures, PicturesAreLookedAt) {
  const struct {
    const char *Content, *Message;
  } Cases[] = {{"text", "a text, expected a picture as PNG, JPEG or WebP"},
               {"small", "3x5 pixels, expected 8x6 as in its camera"}};
  for (const auto &[Content, Message] : Cases) {
    Folder Files = folderOf(GetParam(), sampleCapture());
    auto Picture = std::ranges::find_if(
        Files, [](const auto &F) { return F.first.ends_with("a1.png"); });
    ASSERT_NE(Picture, Files.end());
    Picture->second = std::string(Content) == "small"
                          ? pngOf(3, 5, std::string(60, '\x7f'))
                          : Content;
    const CaptureFolder F(Files);
    const auto C = readCapture(F.path());
    ASSERT_FALSE(C) << Message;
    EXPECT_EQ(C.error().Code, ExitCode::InputFile);
    EXPECT_NE(C.error().Where.find("a1"), std::string::npos);
    EXPECT_NE(C.error().What.find(Message), std::string::npos)
        << C.error().What;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, Captures,
                         ::testing::Values(CaptureFormat::ColmapText,
                                           CaptureFormat::ColmapBinary,
                                           CaptureFormat::NerfSynthetic,
                                           CaptureFormat::Transforms),
                         [](const auto &Info) {
                           std::string Name(name(Info.param));
                           std::erase(Name, '-');
                           return Name;
                         });

TEST(Capture, RingIsThatOfTheTrainingCameras) {
  const CaptureFolder F(colmapTextOf(sampleCapture()));
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C);
  // Ten cameras 3 away from the origin add up to nothing; without the first
  // and the ninth, the centre is minus an eighth of their sum.
  const CameraRing Ring = cameraRing(*C);
  const Camera &A = C->Views[0].Pose, &B = C->Views[8].Pose;
  double Farthest = 0;
  for (std::size_t K = 0; K < 3; ++K)
    EXPECT_NEAR(Ring.Centre[K], -(A.Position[K] + B.Position[K]) / 8, 1e-12);
  for (const CaptureView &V : C->Views) {
    double Squares = 0;
    for (std::size_t K = 0; K < 3 && !V.HeldOut; ++K)
      Squares += std::pow(V.Pose.Position[K] - Ring.Centre[K], 2.0);
    Farthest = std::max(Farthest, std::sqrt(Squares));
  }
  EXPECT_NEAR(Ring.Radius, Farthest, 1e-12);
  EXPECT_NEAR(Ring.extent(), 1.1 * Farthest, 1e-12);
}

TEST(Capture, PlacesWithoutOneAreRefused) {
  const CaptureFolder F({{"readme.txt", "nothing"}});
  EXPECT_FALSE(isCapture(F.path()));
  const auto C = readCapture(F.path());
  ASSERT_FALSE(C);
  EXPECT_NE(C.error().What.find("not a capture"), std::string::npos);
  const auto None = readCapture(F.path("nowhere"));
  ASSERT_FALSE(None);
  EXPECT_NE(None.error().What.find("expected a capture"), std::string::npos);
}

TEST(Capture, NamesOccurOnce) {
  SampleCapture S = sampleCapture();
  S.Views[3].Name = S.Views[4].Name;
  const CaptureFolder F(colmapTextOf(S));
  const auto C = readCapture(F.path());
  ASSERT_FALSE(C);
  EXPECT_NE(C.error().What.find("duplicate picture"), std::string::npos);
}

// One picture as so many views would be that often in memory.
TEST(Capture, APictureOccursOnceUnderAnyName) {
  for (const char *Other : {"pictures/.//a0.png", "pictures/a0"}) {
    Folder Files = transformsOf(sampleCapture());
    Files["transforms.json"] =
        replaced(Files["transforms.json"], "pictures/a1.png", Other);
    const CaptureFolder F(Files);
    const auto C = readCapture(F.path());
    ASSERT_FALSE(C) << Other;
    EXPECT_NE(C.error().What.find("duplicate picture"), std::string::npos)
        << C.error().What;
  }
}

TEST(Capture, PathsStayInTheFolderUnlessAllowed) {
  const auto Expect = [](const CaptureFolder &F, const std::string &Path,
                         const std::string &File) {
    const auto C = readCapture(Path);
    ASSERT_FALSE(C);
    EXPECT_EQ(C.error().Code, ExitCode::InputFile);
    EXPECT_TRUE(C.error().Where.ends_with(File)) << C.error().Where;
    EXPECT_NE(C.error().What.find("expected a file inside the folder, or "
                                  "--allow-outside"),
              std::string::npos)
        << C.error().What;
    EXPECT_TRUE(readCapture(Path, {{}, true})) << F.path();
  };
  {
    Folder Files = transformsOf(sampleCapture());
    Files["inner/transforms.json"] = Files["transforms.json"];
    for (int I = 0; I < 10; ++I)
      Files["inner/transforms.json"] = replaced(
          Files["inner/transforms.json"], "./pictures/a" + std::to_string(I),
          "../pictures/a" + std::to_string(I));
    const CaptureFolder F(Files);
    Expect(F, F.path("inner"), "inner/transforms.json");
  }
  {
    Folder Files = transformsOf(sampleCapture());
    Files["outside.ply"] = pointCloudOf(sampleCapture());
    const CaptureFolder Outside(Files);
    Files["transforms.json"] =
        replaced(Files["transforms.json"], "\"frames\"",
                 "\"ply_file_path\": \"" + Outside.path("outside.ply") +
                     "\", \"frames\"");
    const CaptureFolder F(Files);
    Expect(F, F.path(), "transforms.json");
  }
  {
    Folder Files = colmapTextOf(sampleCapture());
    Files["elsewhere.png"] = Files["images/a3.png"];
    Files["sparse/0/images.txt"] =
        replaced(Files["sparse/0/images.txt"], "a3.png", "../elsewhere.png");
    const CaptureFolder F(Files);
    Expect(F, F.path(), "sparse/0/images.txt");
  }
}

TEST(Capture, APointCloudThatNeverEndsIsAnError) {
  Folder Files = transformsOf(sampleCapture());
  Files["transforms.json"] =
      replaced(Files["transforms.json"], "\"frames\"",
               "\"ply_file_path\": \"/dev/zero\", \"frames\"");
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path(), {{}, true});
  ASSERT_FALSE(C);
  EXPECT_EQ(C.error().Where, "/dev/zero");
}

TEST(Capture, TestPicturesMayBeMissingInPart) {
  Folder Files = nerfSyntheticOf(sampleCapture());
  Files.erase("all/a9.png");
  {
    const CaptureFolder F(Files);
    const auto C = readCapture(F.path());
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->Views.size(), 9U);
    EXPECT_EQ(C->heldOut(), 1U);
    EXPECT_EQ(C->WithoutPicture, 1U);
  }
  // Without any of them some of the others judge.
  Files.erase("all/a8.png");
  {
    const CaptureFolder F(Files);
    const auto C = readCapture(F.path());
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->Views.size(), 8U);
    EXPECT_EQ(C->HeldOutBy, "every 8th in order of names");
    EXPECT_EQ(C->heldOut(), 1U);
  }
  for (int N = 0; N != 8; ++N)
    Files.erase("all/a" + std::to_string(N) + ".png");
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path());
  ASSERT_FALSE(C);
  EXPECT_NE(C.error().What.find("no such picture, nor any other"),
            std::string::npos);
}

TEST(Capture, TheCallerMayChooseWhatIsHeldOut) {
  const CaptureFolder F(nerfSyntheticOf(sampleCapture()));
  CaptureOptions Options;
  Options.HoldOut = 3;
  const auto C = readCapture(F.path(), Options);
  ASSERT_TRUE(C) << C.error().What;
  EXPECT_EQ(C->heldOut(), 4U); // of 10, whatever its test set is
  EXPECT_EQ(C->HeldOutBy, "every 3rd in order of names");
  Options.HoldOut = 0;
  EXPECT_EQ(readCapture(F.path(), Options)->heldOut(), 0U);
  Options.HoldOut = 1;
  const auto All = readCapture(F.path(), Options);
  ASSERT_FALSE(All);
  EXPECT_NE(All.error().What.find("no view to train on"), std::string::npos);
}

TEST(Capture, OfOneOrTwoViewsNoneIsHeldOut) {
  for (const std::size_t Views : {1U, 2U}) {
    const CaptureFolder F(colmapTextOf(sampleCapture(Views)));
    const auto C = readCapture(F.path());
    ASSERT_TRUE(C) << C.error().What;
    EXPECT_EQ(C->Views.size(), Views);
    EXPECT_EQ(C->heldOut(), 0U);
    EXPECT_TRUE(C->HeldOutBy.starts_with("none, of")) << C->HeldOutBy;
    EXPECT_GT(sceneExtent(*C), 0);
  }
}

TEST(Capture, CamerasAtOnePlaceHaveTheExtentOfTheirPoints) {
  Capture C;
  C.Views.resize(2);
  EXPECT_EQ(sceneExtent(C), 0);
  C.Points.Positions = {1, 0, 0, 0, 5, 0, 0, 0, -100};
  C.Points.Colours.resize(9);
  EXPECT_EQ(sceneExtent(C), 5);
}

TEST(Capture, PicturesOfAnotherSizeScaleTheirIntrinsics) {
  Folder Files = colmapTextOf(sampleCapture());
  Files["images/a1.png"] = pngOf(16, 12, std::string(4 * 16 * 12, '\x7f'));
  Files["images/a2.png"] = pngOf(6, 8, std::string(4 * 6 * 8, '\x7f'));
  {
    const CaptureFolder F(Files);
    EXPECT_FALSE(readCapture(F.path())); // a2 is turned
  }
  Files.erase("images/a2.png");
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().What;
  const Camera &Scaled = C->Views[1].Pose;
  EXPECT_EQ(Scaled.Width, 16);
  EXPECT_EQ(Scaled.Fx, 20);
  EXPECT_EQ(Scaled.Fy, 22);
  EXPECT_EQ(Scaled.Cx, 8.5);
  EXPECT_EQ(C->Views[0].Pose.Fx, 10);
  EXPECT_EQ(C->Notes, (std::vector<std::string>{
                          "intrinsics of 1 camera scaled to their pictures: "
                          "a1.png from 8x6 to 16x12"}));
}

TEST(Capture, AFileIsThePictureOfOneName) {
  // a1.png is there for its own name: it does not stand for A1.PNG, too.
  SampleCapture S = sampleCapture(3);
  S.Views[2].Name = "A1.PNG";
  Folder Files = colmapTextOf(S);
  Files.erase("images/A1.PNG");
  const CaptureFolder F(Files);
  const auto C = readCapture(F.path());
  ASSERT_TRUE(C) << C.error().What;
  EXPECT_EQ(C->Views.size(), 2U);
  EXPECT_EQ(C->WithoutPicture, 1U);
}

} // namespace
