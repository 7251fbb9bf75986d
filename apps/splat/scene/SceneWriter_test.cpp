#include "scene/SceneWriter.h"

#include "io/Hash.h"
#include "io/TestFiles.h"
#include "scene/SceneFile.h"
#include "scene/testing/SceneWriters.h"

#include <filesystem>
#include <set>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

TEST(SceneWriter, InriasPlyKeepsEveryBit) {
  const TestFolder Folder;
  const auto W =
      writeScene(Folder.path("s.ply"), randomScene(300, 2, 1), Drawing());
  ASSERT_TRUE(W) << W.error().What;
  const SceneDifference &L = W->Lost;
  EXPECT_EQ(L.Position + L.LogScale + L.Rotation + L.Opacity + L.Color +
                L.Harmonics,
            0);
  EXPECT_EQ(W->ShDegree, 2);
}

TEST(SceneWriter, EachFormatIsReadAsItselfWithinItsSteps) {
  const TestFolder Folder;
  const Scene S = randomScene(600, 3, 2);
  const struct {
    const char *Ending;
    SceneFormat Format;
    SceneDifference Most;
  } Cases[] = {
      // Bounds of 256 neighbours of 600 are up to the scene's 100 units wide.
      {".compressed.ply",
       SceneFormat::CompressedPly,
       {100.0 / 1023 / 2 + 1e-5, 8.0 / 1023 / 2 + 1e-6, 0.0021,
        0.5 / 255 + 1e-6, 1.8 / 255 / 2 + 1e-6, 8.0 / 256 / 2 + 1e-6}},
      {".splat",
       SceneFormat::Splat,
       {0, 1e-6, 1.0 / 64, 0.5 / 255 + 1e-6, 0.5 / 255 / ShC0 + 1e-6, 0.9}},
      {".spz",
       SceneFormat::Spz,
       {0.5 / 4096 + 1e-6, 0.5 / 16 + 1e-6, 0.0021, 0.5 / 255 + 1e-6,
        0.5 / 255 / 0.15 + 1e-6, 8.5 / 128 + 1e-6}},
      {".glb", SceneFormat::Gltf, {0, 1e-6, 1e-6, 1e-7, 0, 0}},
      // Even steps of a byte would be within half of a 255th: the codebooks'
      // are nearer where values crowd and may be farther where they do not.
      {".sog",
       SceneFormat::Sog,
       {51.0 * 8 / 65535 / 2 + 1e-4, 8.0 / 255, 3 * 0.5 / 127.5 / 1.41,
        0.5 / 255 + 1e-6, 1.8 / 255, 1.8 / 255}}};
  for (const auto &Case : Cases) {
    const std::string Path = Folder.path(std::string("s") + Case.Ending);
    const auto W = writeScene(Path, S, Drawing());
    ASSERT_TRUE(W) << W.error().What;
    const auto Read = readScene(Path);
    ASSERT_TRUE(Read) << Read.error().What;
    EXPECT_EQ(Read->Format, Case.Format);
    EXPECT_EQ(Read->Gaussians.size(), S.size());
    EXPECT_EQ(W->ShDegree, Case.Format == SceneFormat::Splat ? 0 : 3);
    EXPECT_LE(W->Lost.Position, Case.Most.Position) << Case.Ending;
    EXPECT_LE(W->Lost.LogScale, Case.Most.LogScale) << Case.Ending;
    EXPECT_LE(W->Lost.Rotation, Case.Most.Rotation) << Case.Ending;
    EXPECT_LE(W->Lost.Opacity, Case.Most.Opacity) << Case.Ending;
    EXPECT_LE(W->Lost.Color, Case.Most.Color) << Case.Ending;
    EXPECT_LE(W->Lost.Harmonics, Case.Most.Harmonics) << Case.Ending;
    EXPECT_GT(W->Lost.Opacity, 0) << Case.Ending; // the comparison sees it
  }
}

TEST(SceneWriter, ASogsFolderIsTheArchivesScene) {
  const TestFolder Folder;
  const Scene S = randomScene(300, 1, 6);
  const std::string Index = Folder.path("meta.json");
  ASSERT_TRUE(writeScene(Folder.path("s.sog"), S, Drawing()));
  // Over another one, too.
  ASSERT_TRUE(writeScene(Index, randomScene(20, 0, 7), Drawing()));
  const auto W = writeScene(Index, S, Drawing());
  ASSERT_TRUE(W) << W.error().What;
  EXPECT_EQ(W->ShDegree, 1);
  EXPECT_GT(W->Lost.Opacity, 0);
  const auto Archive = readScene(Folder.path("s.sog"));
  const auto Read = readScene(Index);
  ASSERT_TRUE(Archive && Read);
  EXPECT_EQ(Read->Gaussians.Means, Archive->Gaussians.Means);
  EXPECT_EQ(Read->Gaussians.LogScales, Archive->Gaussians.LogScales);
  EXPECT_EQ(Read->Gaussians.Quats, Archive->Gaussians.Quats);
  EXPECT_EQ(Read->Gaussians.OpacityLogits, Archive->Gaussians.OpacityLogits);
  EXPECT_EQ(Read->Gaussians.Sh, Archive->Gaussians.Sh);
  const auto Refused = writeScene(Folder.path("s.meta.json"), S, Drawing());
  ASSERT_FALSE(Refused);
  EXPECT_EQ(Refused.error().What,
            "not the name of a SOG index, expected meta.json");
}

TEST(SceneWriter, ASogsFolderThatCannotBeWrittenStaysAsItWas) {
  const TestFolder Folder;
  const std::string Index = Folder.path("meta.json");
  const auto Hash = [&] {
    const auto H = hashScene(Index);
    return H ? *H : H.error().What;
  };
  const auto W = writeScene(Index, randomScene(20, 1, 7), Drawing());
  ASSERT_TRUE(W) << W.error().What;
  // The last of its pictures that is written.
  std::filesystem::rename(Folder.path("shN_labels.webp"), Folder.path("kept"));
  std::filesystem::create_directory(Folder.path("shN_labels.webp"));
  const auto Failed = writeScene(Index, randomScene(30, 1, 8), Drawing());
  ASSERT_FALSE(Failed);
  EXPECT_EQ(Failed.error().Where, Folder.path("shN_labels.webp"));
  std::filesystem::remove(Folder.path("shN_labels.webp"));
  std::filesystem::rename(Folder.path("kept"), Folder.path("shN_labels.webp"));
  EXPECT_EQ(Hash(), W->Hash);
  EXPECT_EQ(
      std::distance(std::filesystem::directory_iterator(Folder.path("")), {}),
      8)
      << "seven pictures and the index";
}

TEST(SceneWriter, SaysWhetherTheFileTellsHowItIsDrawn) {
  const TestFolder Folder;
  const Scene S = randomScene(4, 0, 3);
  Drawing Mip;
  Mip.Antialiased = true;
  Drawing Brush = Mip;
  Brush.Dilation = 0.1;
  const auto Keeps = [&](const char *Name, const Drawing &D) {
    const auto W = writeScene(Folder.path(Name), S, D);
    return W && W->KeepsDrawing;
  };
  EXPECT_TRUE(Keeps("a.compressed.ply", Brush));
  EXPECT_TRUE(Keeps("a.ply", Brush));
  EXPECT_TRUE(Keeps("a.spz", Mip));
  EXPECT_FALSE(Keeps("a.spz", Brush));
  EXPECT_TRUE(Keeps("a.splat", Drawing()));
  EXPECT_FALSE(Keeps("a.splat", Mip));
}

TEST(SceneWriter, LargeScenesHaveCoarserSpzAndTheLargestNone) {
  const TestFolder Folder;
  Scene S = randomScene(4, 0, 4);
  S.Means[0] = 100000.25F; // 7 bits behind the point are left
  const auto W = writeScene(Folder.path("a.spz"), S, Drawing());
  ASSERT_TRUE(W) << W.error().What;
  EXPECT_LE(W->Lost.Position, 0.5 / 64 + 1e-6);
  S.Means[0] = 1e8F;
  const auto Refused = writeScene(Folder.path("b.spz"), S, Drawing());
  ASSERT_FALSE(Refused);
  EXPECT_TRUE(Refused.error().Where.ends_with("b.spz"));
}

TEST(SceneWriter, ExtremeValuesAreCutToWhatTheFormatHas) {
  const TestFolder Folder;
  Scene S = randomScene(3, 1, 5);
  S.OpacityLogits = {-30, 30, 0};
  S.LogScales = {-20, 20, 0, 0, 0, 0, 0, 0, 0};
  S.Quats = {0, 0, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1e-12F};
  S.Sh[0] = 100;
  S.Sh[5] = -100;
  const auto Lossless = writeScene(Folder.path("a.glb"), S, Drawing());
  ASSERT_TRUE(Lossless) << Lossless.error().What;
  EXPECT_LE(Lossless->Lost.LogScale, 1e-5);
  EXPECT_EQ(Lossless->Lost.Harmonics, 0);
  for (const char *Name : {"a.compressed.ply", "a.splat", "a.spz"}) {
    const auto W = writeScene(Folder.path(Name), S, Drawing());
    ASSERT_TRUE(W) << Name << W.error().What;
    EXPECT_LE(W->Lost.Opacity, 0.5 / 255 + 1e-6) << Name;
    EXPECT_LE(W->Lost.Rotation, 1.0 / 64) << Name;
    EXPECT_GT(W->Lost.Harmonics, 50) << Name;
  }
}

} // namespace
