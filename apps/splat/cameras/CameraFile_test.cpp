#include "cameras/CameraFile.h"

#include "capture/Capture.h"
#include "capture/CaptureTest.h"

#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

/// The cameras at \p Path are those that training sees, and no picture or
/// point is needed for them: \p Needless names what is removed first.
void expectCapture(const Folder &Files, const std::string &Path = "") {
  const CaptureFolder Whole(Files);
  const auto Wanted = readCapture(Whole.path());
  ASSERT_TRUE(Wanted) << Wanted.error().What;
  Folder Bare;
  for (const auto &[Name, Content] : Files)
    if (!Name.starts_with("images/") && !Name.starts_with("pictures/") &&
        Name.find("points3D") == std::string::npos)
      Bare[Name] = Content;
  const CaptureFolder F(Bare);
  const auto Read = readCameraFile(F.path(Path));
  ASSERT_TRUE(Read) << Read.error().Where << ": " << Read.error().What;
  ASSERT_EQ(Read->Cameras.size(), Wanted->Views.size());
  for (std::size_t I = 0; I < Read->Cameras.size(); ++I)
    EXPECT_EQ(Read->Cameras[I], Wanted->Views[I].Pose);
  EXPECT_TRUE(hashCameraFile(F.path(Path)));
}

TEST(CameraFile, CapturesNeedNoPicturesAndNoPoints) {
  const SampleCapture C = sampleCapture();
  expectCapture(colmapBinaryOf(C));
  expectCapture(colmapTextOf(C));
  expectCapture(transformsOf(C));
  expectCapture(colmapBinaryOf(C), "sparse/0");
  expectCapture(colmapBinaryOf(C), "sparse/0/images.bin");
  expectCapture(colmapTextOf(C), "sparse/0/cameras.txt");
  expectCapture(transformsOf(C), "transforms.json");
}

TEST(CameraFile, FilesAreTheCaptures) {
  const CaptureFolder F(transformsOf(sampleCapture()));
  EXPECT_EQ(cameraFiles(F.path()), captureFiles(F.path()));
  EXPECT_EQ(cameraFiles(F.path("transforms.json")).size(), 11U);
}

TEST(CameraFile, TheFileOfAListIsTheList) {
  const TestFolder Folder;
  const std::string List = Folder.write("cameras.json", "[]");
  EXPECT_EQ(cameraFiles(List), std::vector<std::string>{List});
  EXPECT_EQ(cameraFiles(Folder.path("")), std::vector<std::string>{List});
}

TEST(CameraFile, SyntheticCapturesHaveBothSets) {
  const CaptureFolder F(nerfSyntheticOf(sampleCapture()));
  const auto Read = readCameraFile(F.path());
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Cameras.size(), 10U);
  EXPECT_EQ(Read->Files.size(), 2U);
  EXPECT_EQ(Read->Cameras.front().Width, 8);
}

TEST(CameraFile, TrainersOutputFoldersHaveTheirList) {
  const TestFolder F;
  const std::string Path = F.path("cameras.json");
  Camera C = Camera::ahead(8, 6, 10);
  C.Name = "one";
  ASSERT_TRUE(writeCameras(Path, {C}));
  for (const std::string &At : {Path, F.path("")}) {
    const auto Read = readCameraFile(At);
    ASSERT_TRUE(Read) << Read.error().What;
    EXPECT_EQ(Read->Cameras, std::vector{C});
  }
}

TEST(CameraFile, WhatHasNoCamerasIsRefused) {
  const TestFolder F;
  const auto Expect = [&](const std::string &Path, const char *Message) {
    const auto Read = readCameraFile(Path);
    ASSERT_FALSE(Read);
    EXPECT_NE(Read.error().What.find(Message), std::string::npos)
        << Read.error().What;
  };
  Expect(F.path(""), "not a capture");
  Expect(F.path("none.json"), "cannot open");
  F.write("a.json", "{\"views\": []}");
  Expect(F.path("a.json"), "no cameras, expected");
  F.write("b.json", "nothing");
  Expect(F.path("b.json"), "expected");
}

TEST(CameraFile, NoFileOutsideIsOpenedForASize) {
  Folder Files = nerfSyntheticOf(sampleCapture());
  auto J = nlohmann::json::parse(Files["transforms_train.json"]);
  J["frames"][0]["file_path"] = "../elsewhere";
  Files["transforms_train.json"] = J.dump();
  const CaptureFolder F(Files);
  const auto Read = readCameraFile(F.path());
  ASSERT_FALSE(Read);
  EXPECT_NE(Read.error().What.find("../elsewhere"), std::string::npos);
}

TEST(CameraFile, ViewsMayBeNamedWithoutFolderAndEnding) {
  std::vector<Camera> Cameras(3, Camera::ahead(8, 6, 10));
  Cameras[0].Name = "left/01.jpg";
  Cameras[1].Name = "left/02.jpg";
  Cameras[2].Name = "right/02.jpg";
  const auto Find = [&](const std::string &View) {
    return selectCameras("file", Cameras, {View});
  };
  EXPECT_EQ(Find("01.jpg")->front().Name, "left/01.jpg");
  EXPECT_EQ(Find("01")->front().Name, "left/01.jpg");
  EXPECT_FALSE(Find("02")); // of which there are two
  EXPECT_EQ(Find("right/02.jpg")->front().Name, "right/02.jpg");
}

} // namespace
