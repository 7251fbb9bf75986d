#include "scene/SceneFiles.h"

#include "io/TestFiles.h"
#include "scene/testing/SceneWriters.h"

#include <algorithm>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <vector>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

/// The names of \p Path's files, from \p Root on.
std::vector<std::string> namesOf(const TestFolder &Root,
                                 const std::string &Path) {
  std::vector<std::string> Names;
  for (const std::string &File : sceneFiles(Path))
    Names.push_back(
        std::filesystem::path(File).lexically_relative(Root.path("")).string());
  std::ranges::sort(Names);
  return Names;
}

using Strings = std::vector<std::string>;

TEST(SceneFiles, AFileStandsAlone) {
  const TestFolder Root;
  Root.write("s.ply", "ply\n");
  Root.write("meta.json", R"({"means": {"files": ["s.ply"]}})");
  EXPECT_EQ(namesOf(Root, Root.path("s.ply")), Strings{"s.ply"});
  EXPECT_EQ(namesOf(Root, Root.path("absent")), Strings{"absent"});
}

TEST(SceneFiles, AFolderHasWhatItsDescriptionNames) {
  const TestFolder Root;
  Root.write("meta.json", R"({"means": {"files": ["l.webp", "gone.webp"]},
                              "sh0": {"files": ["../out", "sh0.webp"]}})");
  for (const char *Name : {"l.webp", "sh0.webp", "beside.webp"})
    Root.write(Name, "RIFF");
  const Strings Wanted{"l.webp", "meta.json", "sh0.webp"};
  EXPECT_EQ(namesOf(Root, Root.path("")), Wanted);
  EXPECT_EQ(namesOf(Root, Root.path("meta.json")), Wanted);
}

TEST(SceneFiles, AStreamedSceneHasTheFilesOfItsChunks) {
  const TestFolder Root;
  std::filesystem::create_directory(Root.path("0_0"));
  Root.write("lod-meta.json", R"({"filenames": ["0_0/meta.json"]})");
  Root.write("0_0/meta.json", R"({"means": {"files": ["l.webp"]}})");
  Root.write("0_0/l.webp", "RIFF");
  EXPECT_EQ(namesOf(Root, Root.path("")),
            (Strings{"0_0/l.webp", "0_0/meta.json", "lod-meta.json"}));
  std::filesystem::remove(Root.path("lod-meta.json"));
  EXPECT_EQ(namesOf(Root, Root.path("")),
            (Strings{"0_0/l.webp", "0_0/meta.json"}))
      << "chunks side by side";
}

TEST(SceneFiles, DescriptionsThatNameEachOtherEnd) {
  const TestFolder Root;
  Root.write("meta.json", R"({"a": "b.json"})");
  Root.write("b.json", R"({"a": "meta.json", "c": {)");
  EXPECT_EQ(namesOf(Root, Root.path("")), (Strings{"b.json", "meta.json"}));
}

} // namespace
