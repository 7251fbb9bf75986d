#include "io/TestFiles.h"
#include "scene/Edit.h"
#include "scene/SceneFile.h"
#include "scene/formats/Ply.h"
#include "scene/testing/Compare.h"
#include "scene/testing/Damage.h"
#include "scene/testing/SceneWriters.h"

#include <algorithm>
#include <cstring>
#include <fmt/format.h>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

TEST(SceneFile, IsToldByItsContentNotItsName) {
  const TestFolder Root;
  for (const SampleFile &F : sampleFiles()) {
    const auto Read = readScene(Root.write("scene.ply", F.Content));
    ASSERT_TRUE(Read) << F.Name << ": " << Read.error().What;
    EXPECT_TRUE(F.Name.ends_with(recordOf(Read->Format).Ending))
        << F.Name << " read as " << name(Read->Format);
  }
}

TEST(SceneFile, EveryFormatIsInTheDocuments) {
  std::ifstream Document("docs/scenes.md");
  ASSERT_TRUE(Document);
  std::vector<std::string> Rows;
  for (std::string Line; std::getline(Document, Line);)
    if (Line.starts_with("| ")) {
      std::erase(Line, '`');
      Rows.push_back(Line);
    }
  for (const SceneFormatRecord &F : sceneFormats())
    EXPECT_TRUE(std::ranges::any_of(
        Rows,
        [&](const std::string &Row) {
          return Row.starts_with(fmt::format("| {}", F.Title)) &&
                 Row.find(F.Axes.empty()
                              ? fmt::format("none; {} by custom", CustomaryAxes)
                              : std::string(F.Axes)) != std::string::npos;
        }))
        << F.Title << ", " << F.Axes;
}

TEST(SceneFile, MissingFilesAndEmptyFoldersAreErrors) {
  const TestFolder Root;
  for (const std::string &Path :
       {Root.path("absent"), Root.path("."), std::string()}) {
    const auto Read = readScene(Path);
    ASSERT_FALSE(Read) << Path;
    EXPECT_EQ(Read.error().Code, ExitCode::InputFile);
  }
}

TEST(SceneFile, EveryValueThatIsNotFiniteIsFound) {
  for (const float Bad : {std::numeric_limits<float>::quiet_NaN(),
                          std::numeric_limits<float>::infinity(),
                          -std::numeric_limits<float>::infinity()})
    for (int Field = 0; Field < 5; ++Field) {
      Scene S = numberedScene(3, 1);
      std::vector<float> *Fields[] = {&S.Means, &S.LogScales, &S.Quats,
                                      &S.OpacityLogits, &S.Sh};
      std::vector<float> &V = *Fields[Field];
      V[2 * V.size() / 3 - 1] = Bad; // the last of Gaussian 1
      const auto Checked = checkFinite("s", S);
      ASSERT_FALSE(Checked);
      constexpr const char *Parts[] = {"position", "scales", "rotation",
                                       "opacity", "colours"};
      EXPECT_EQ(Checked.error().What,
                fmt::format("Gaussian 1 has a NaN or an infinity in its {}, "
                            "expected finite values",
                            Parts[Field]));
    }
  EXPECT_TRUE(checkFinite("s", numberedScene(3, 1)));
}

constexpr float NaN = std::numeric_limits<float>::quiet_NaN();

TEST(SceneFile, GaussiansThatAreNotFiniteAreDroppedOnRequestAndCounted) {
  const TestFolder Root;
  const Scene S = numberedScene(5, 1);
  for (int Field = 0; Field < 5; ++Field) {
    Scene Bad = S;
    std::vector<float> *Fields[] = {&Bad.Means, &Bad.LogScales, &Bad.Quats,
                                    &Bad.OpacityLogits, &Bad.Sh};
    std::vector<float> &V = *Fields[Field];
    V[V.size() / 5] = NaN; // the first of Gaussian 1
    V.back() = std::numeric_limits<float>::infinity();
    if (&V == &Bad.OpacityLogits) // opaque
      V.back() = NaN;
    const std::string Path = Root.write("s.ply", formatPly(Bad));
    EXPECT_FALSE(readScene(Path));
    const auto Read = readScene(Path, {.DropNonFinite = true, .Drawn = {}});
    ASSERT_TRUE(Read) << Read.error().What;
    EXPECT_EQ(Read->Dropped, 2U);
    Scene Left = Scene::sized(0, 1);
    append(Left, S, 0, 1);
    append(Left, S, 2, 2);
    EXPECT_EQ(Read->Gaussians.Means, Left.Means);
    EXPECT_EQ(Read->Gaussians.LogScales, Left.LogScales);
    EXPECT_EQ(Read->Gaussians.Quats, Left.Quats);
    EXPECT_EQ(Read->Gaussians.OpacityLogits, Left.OpacityLogits);
    EXPECT_EQ(Read->Gaussians.Sh, Left.Sh);
  }
  const auto None = readScene(Root.write("s.ply", formatPly(S)),
                              {.DropNonFinite = true, .Drawn = {}});
  ASSERT_TRUE(None);
  EXPECT_EQ(None->Dropped, 0U);
}

TEST(SceneFile, ASceneOfNothingElseIsAnErrorAllTheSame) {
  Scene S = numberedScene(3, 0);
  for (float &V : S.Means)
    V = NaN;
  const std::string Ply = formatPly(S);
  const auto Read = parseScene("s", std::as_bytes(std::span(Ply)),
                               {.DropNonFinite = true, .Drawn = {}});
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What, "all 3 Gaussians have a NaN or an infinity, "
                               "expected at least one finite Gaussian");
}

// Two formats see such values before a scene is there.
TEST(SceneFile, SplatAndSogDropToo) {
  const Scene S = randomScene(5, 0, 1);
  std::string Splat = splatOf(S);
  std::memcpy(Splat.data() + 32, &NaN, sizeof(NaN));
  const float Minus = -std::numeric_limits<float>::infinity();
  std::memcpy(Splat.data() + 3 * 32 + 16, &Minus, sizeof(Minus));
  const auto ReadSplat = parseScene("s", std::as_bytes(std::span(Splat)),
                                    {.DropNonFinite = true, .Drawn = {}});
  ASSERT_TRUE(ReadSplat) << ReadSplat.error().What;
  EXPECT_EQ(ReadSplat->Dropped, 2U);

  // Writers of SOG leave null where a codebook has a NaN.
  Folder Files = sogOf(S);
  nlohmann::json Meta = nlohmann::json::parse(Files["meta.json"]);
  Meta["scales"]["codebook"][255] = nullptr;
  Files["meta.json"] = Meta.dump();
  const std::string Sog = zipOf(Files);
  EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(Sog))));
  const auto ReadSog = parseScene("s", std::as_bytes(std::span(Sog)),
                                  {.DropNonFinite = true, .Drawn = {}});
  ASSERT_TRUE(ReadSog) << ReadSog.error().What;
  // The writer's last step is the largest scale, which one Gaussian has.
  EXPECT_EQ(ReadSog->Dropped, 1U);
  EXPECT_EQ(ReadSog->Gaussians.size(), 4U);
}

TEST(SceneFile, WhatNeverEndsIsAnError) {
  const auto Read = readScene("/dev/zero");
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().Where, "/dev/zero");
  EXPECT_EQ(Read.error().Code, ExitCode::InputFile);
}

TEST(SceneFile, HarmonicsOfDegreeFourAreReducedToThree) {
  const Scene Four = randomScene(20, 4, 3);
  Scene Three = Four;
  setShDegree(Three, 3);
  const auto FilesOf = [](const Scene &S) -> std::vector<std::string> {
    return {formatPly(S),
            compressedPlyOf(S),
            gzipOf(spzBodyOf(S, 3)),
            zipOf(sogOf(S)),
            glbOf(gltfOf(S)),
            glbOf(gltfOfSpz(gzipOf(spzBodyOf(S, 2))))};
  };
  const auto Files = FilesOf(Four), Expected = FilesOf(Three);
  for (std::size_t I = 0; I < Files.size(); ++I) {
    const auto Read = parseScene("s", std::as_bytes(std::span(Files[I])));
    const auto Wanted = parseScene("s", std::as_bytes(std::span(Expected[I])));
    ASSERT_TRUE(Read) << Read.error().What;
    ASSERT_TRUE(Wanted) << Wanted.error().What;
    EXPECT_EQ(Read->ReducedFrom, 4);
    EXPECT_EQ(Wanted->ReducedFrom, 0);
    EXPECT_EQ(Read->Gaussians.Means, Wanted->Gaussians.Means);
    EXPECT_LE(differencesOf(Read->Gaussians, Wanted->Gaussians).Harmonics,
              0.03);
  }
}

TEST(SceneFile, InfinitiesWithAMeaningAreRead) {
  constexpr float Infinity = std::numeric_limits<float>::infinity();
  Scene S = randomScene(4, 0, 3);
  S.OpacityLogits[0] = Infinity;
  S.OpacityLogits[1] = -Infinity;
  S.LogScales[6] = -Infinity;
  S.LogScales[9] = Infinity;
  const std::string File = formatPly(S);
  const auto Refused = parseScene("s", std::as_bytes(std::span(File)));
  ASSERT_FALSE(Refused);
  EXPECT_NE(Refused.error().What.find("Gaussian 3"), std::string::npos);
  ReadOptions Drop;
  Drop.DropNonFinite = true;
  const auto Read = parseScene("s", std::as_bytes(std::span(File)), Drop);
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Dropped, 1U);
  EXPECT_EQ(Read->Gaussians.size(), 3U);
}

} // namespace
