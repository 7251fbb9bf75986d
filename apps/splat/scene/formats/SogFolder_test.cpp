#include "io/TestFiles.h"
#include "scene/formats/SogFolder.h"
#include "scene/testing/Compare.h"
#include "scene/testing/Damage.h"

#include <functional>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

using Json = nlohmann::json;

bool isSogJson(const Json &Value) {
  const std::string Text = Value.dump();
  return vorion::splat::isSogJson(std::as_bytes(std::span(Text)));
}

/// Writes \p Files below \p Name and gives the path.
std::string written(const TestFolder &Root, const std::string &Name,
                    const Folder &Files) {
  for (const auto &[File, Content] : Files) {
    const std::filesystem::path Path = Root.path(Name + "/" + File);
    std::filesystem::create_directories(Path.parent_path());
    EXPECT_TRUE(writeFileAtomically(Path.string(), Content));
  }
  return Root.path(Name);
}

SceneFile read(const std::string &Path, const ReadOptions &Options = {}) {
  auto Read = readScene(Path, Options);
  EXPECT_TRUE(Read) << Read.error().Where << ": " << Read.error().What;
  return Read ? std::move(*Read) : SceneFile{};
}

/// Within what SOG keeps of the writers' scenes.
void expectNear(const Scene &A, const Scene &B) {
  const auto D = differencesOf(A, B);
  EXPECT_LE(D.Position, 0.01);
  EXPECT_LE(D.LogScale, 0.02);
}

TEST(SogFolder, AFolderAndItsDescriptionAreTheSameScene) {
  const TestFolder Root;
  const Scene S = randomScene(20, 1, 5);
  const std::string Path = written(Root, "s", sogOf(S));
  const SceneFile Read = read(Path);
  EXPECT_EQ(Read.Format, SceneFormat::Sog);
  expectNear(Read.Gaussians, S);
  EXPECT_EQ(read(Path + "/meta.json").Gaussians.Means, Read.Gaussians.Means);
}

TEST(SogFolder, ADescriptionMayHaveTheKeyAssetAsGltfHas) {
  const TestFolder Root;
  const Scene S = randomScene(20, 1, 5);
  Folder Files = sogOf(S);
  Json Meta = Json::parse(Files["meta.json"]);
  Meta["asset"] = {{"generator", "splat-transform"}};
  Files["meta.json"] = Meta.dump();
  const std::string Path = written(Root, "s", Files);
  for (const std::string &Name : {Path, Path + "/meta.json"})
    EXPECT_EQ(read(Name).Format, SceneFormat::Sog) << Name;
  const Json Index{{"asset", {{"version", "1.0"}}}, {"lodLevels", 1}};
  EXPECT_TRUE(isSogJson(Index));
  // A glTF in which the words occur stays one.
  const Json Mesh{{"asset", {{"version", "2.0"}}},
                  {"extras", {{"means", 1}, {"tree", 2}}}};
  EXPECT_FALSE(isSogJson(Mesh));
}

TEST(SogFolder, ChunksAreJoinedInTheOrderOfTheirNames) {
  const TestFolder Root;
  const Scene A = randomScene(7, 0, 1), B = randomScene(9, 0, 2);
  written(Root, "s/2_1", sogOf(B));
  const std::string Path =
      std::filesystem::path(written(Root, "s/2_0", sogOf(A))).parent_path();
  Scene Both = A;
  append(Both, B, 0, B.size());
  const SceneFile Read = read(Path);
  EXPECT_EQ(Read.Format, SceneFormat::StreamedSog);
  EXPECT_EQ(Read.Files, 2U);
  expectNear(Read.Gaussians, Both);
}

TEST(SogFolder, AStreamedSceneIsOneLevelAndTheEnvironment) {
  const TestFolder Root;
  const Scene Fine = randomScene(9, 1, 2), Coarse = randomScene(4, 1, 3),
              Far = randomScene(3, 1, 4);
  const std::string Path = written(Root, "s", streamedSogOf(Fine, Coarse, Far));
  Scene Expected = Fine;
  append(Expected, Far, 0, Far.size());
  const SceneFile Read = read(Path);
  EXPECT_EQ(Read.Files, 3U);
  expectNear(Read.Gaussians, Expected);
  expectNear(read(Path + "/lod-meta.json").Gaussians, Expected);

  Expected = Coarse;
  append(Expected, Far, 0, Far.size());
  expectNear(read(Path, {.LevelOfDetail = 1, .Drawn = {}}).Gaussians, Expected);
  const auto None = readScene(Path, {.LevelOfDetail = 2, .Drawn = {}});
  ASSERT_FALSE(None);
  EXPECT_EQ(None.error().Code, ExitCode::Usage);
  EXPECT_NE(None.error().What.find("no level of detail 2"), std::string::npos);
}

// An index may list parts of a chunk, and need not list them in order.
TEST(SogFolder, RunsOfAChunkAreTakenInTheirOrderThere) {
  const TestFolder Root;
  const Scene A = randomScene(9, 1, 2), B = randomScene(5, 1, 3);
  Folder Files;
  for (const auto &[Name, Content] : sogOf(A))
    Files["a/" + Name] = Content;
  for (const auto &[Name, Content] : sogOf(B))
    Files["b/" + Name] = Content;
  const auto Leaf = [](int File, int Offset, int Count) {
    return Json{
        {"lods",
         {{"0", {{"file", File}, {"offset", Offset}, {"count", Count}}}}}};
  };
  Files["lod-meta.json"] = Json{
      {"version", 1},
      {"lodLevels", 1},
      {"filenames", {"a/meta.json", "b/meta.json"}},
      {"tree",
       {{"children",
         {Leaf(0, 6, 2), Leaf(1, 2, 3), Leaf(0, 1, 4),
          Leaf(1, 0, 2)}}}}}.dump();
  Scene Expected;
  Expected.ShDegree = 1;
  append(Expected, A, 1, 4);
  append(Expected, A, 6, 2);
  append(Expected, B, 0, 5);
  const SceneFile Read = read(written(Root, "s", Files));
  EXPECT_EQ(Read.Files, 2U);
  ASSERT_EQ(Read.Gaussians.size(), 11U);
  expectNear(Read.Gaussians, Expected);
}

/// What \p Change makes of each chunk's description.
Folder
withChunks(Folder Files,
           const std::function<void(const std::string &, Json &)> &Change) {
  for (auto &[Name, Content] : Files)
    if (Name.ends_with("/meta.json")) {
      Json Meta = Json::parse(Content);
      Change(Name, Meta);
      Content = Meta.dump();
    }
  return Files;
}

TEST(SogFolder, ChunksThatAreDrawnInTwoWaysNeedADecision) {
  const TestFolder Root;
  const Folder Whole = streamedSogOf(randomScene(9, 1, 2), randomScene(4, 1, 3),
                                     randomScene(3, 1, 4));
  const auto All = read(written(
      Root, "all", withChunks(Whole, [](const std::string &, Json &Meta) {
        Meta["model"] = "antialiased";
      })));
  EXPECT_TRUE(All.DrawnAs.Antialiased);
  const std::string Mixed = written(
      Root, "mixed", withChunks(Whole, [](const std::string &Name, Json &Meta) {
        if (Name.starts_with("0_1"))
          Meta["model"] = "antialiased";
      }));
  const auto Read = readScene(Mixed);
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().What,
            "model antialiased, expected no model as in the first chunk, or "
            "--antialiased or --no-antialiased to decide");
  EXPECT_FALSE(read(Mixed, {.Drawn = {.Antialiased = false, .Dilation = {}}})
                   .DrawnAs.Antialiased);
}

/// A source that gives what \p Files has and counts what it is asked for.
struct CountedFiles {
  Folder Files;
  std::size_t Asked = 0;

  Expected<SceneFile> read() {
    const std::string &Index = Files.at("lod-meta.json");
    return parseStreamedSog(
        "s", std::as_bytes(std::span(Index)),
        [this](const std::string &Name,
               std::size_t /*Most*/) -> Expected<std::vector<std::byte>> {
          ++Asked;
          const auto B = std::as_bytes(std::span(
              Files.at(std::filesystem::path(Name).lexically_normal())));
          return std::vector<std::byte>(B.begin(), B.end());
        },
        {});
  }
};

TEST(SogFolder, AChunkNamedManyTimesIsReadOnce) {
  const Scene S = randomScene(9, 0, 2);
  Json Names, Leaves;
  for (int I = 0; I < 600; ++I) {
    // The same file under names that differ.
    Names.push_back(I % 2 ? "c/meta.json" : "./c//meta.json");
    Leaves.push_back(
        {{"lods", {{"0", {{"file", I}, {"offset", 0}, {"count", S.size()}}}}}});
  }
  CountedFiles Files;
  for (const auto &[Name, Content] : sogOf(S))
    Files.Files["c/" + Name] = Content;
  Files.Files["lod-meta.json"] = Json{
      {"version", 1},
      {"lodLevels", 1},
      {"filenames", Names},
      {"tree",
       {{"children", Leaves}}}}.dump();
  const auto Read = Files.read();
  ASSERT_FALSE(Read);
  EXPECT_NE(Read.error().What.find("twice, expected one reference per file"),
            std::string::npos)
      << Read.error().What;
  EXPECT_LE(Files.Asked, 6U);
}

// The same pictures under another description are the same defect.
TEST(SogFolder, PicturesNamedByManyChunksAreReadOnce) {
  const Scene S = randomScene(9, 0, 2);
  CountedFiles Files{sogOf(S)};
  Json Names, Leaves;
  for (int I = 0; I < 600; ++I) {
    Names.push_back("meta" + std::to_string(I) + ".json");
    Files.Files[Names.back()] = Files.Files["meta.json"];
    Leaves.push_back(
        {{"lods", {{"0", {{"file", I}, {"offset", 0}, {"count", S.size()}}}}}});
  }
  Files.Files["lod-meta.json"] = Json{
      {"version", 1},
      {"lodLevels", 1},
      {"filenames", Names},
      {"tree",
       {{"children", Leaves}}}}.dump();
  EXPECT_FALSE(Files.read());
  EXPECT_LE(Files.Asked, 7U);
}

TEST(SogFolder, EachKindOfDamageHasItsMessage) {
  const TestFolder Root;
  for (const DamagedFolder &F : damagedFolders()) {
    const auto Read = readScene(written(Root, F.Name, F.Files));
    ASSERT_FALSE(Read) << F.Name;
    EXPECT_EQ(Read.error().Code, ExitCode::InputFile) << F.Name;
    EXPECT_TRUE(Read.error().Where.starts_with(Root.path(F.Name))) << F.Name;
    EXPECT_NE(Read.error().What.find(F.Message), std::string::npos)
        << F.Name << ": " << Read.error().What;
  }
}

TEST(SogFolder, ATreeDeeperThanAnySceneIsAnError) {
  std::string Tree = R"({"lods":{}})";
  constexpr int Depth = 20000;
  std::string Open, Close;
  for (int I = 0; I < Depth; ++I) {
    Open += R"({"children":[)";
    Close += "]}";
  }
  const std::string Index =
      R"({"version":1,"lodLevels":1,"filenames":[],"tree":)" + Open + Tree +
      Close + "}";
  const auto Read = parseStreamedSog(
      "s", std::as_bytes(std::span(Index)),
      [](const std::string &Name,
         std::size_t /*Most*/) -> Expected<std::vector<std::byte>> {
        return Error{Name, "not asked for"};
      },
      {});
  ASSERT_FALSE(Read);
  EXPECT_EQ(Read.error().Where, "s: lod-meta.json");
  EXPECT_EQ(Read.error().What,
            "lists and objects nested deeper than 256, expected fewer levels");
}

} // namespace
