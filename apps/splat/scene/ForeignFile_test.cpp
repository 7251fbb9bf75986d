#include "io/TestFiles.h"
#include "scene/ForeignFile.h"
#include "scene/SceneFile.h"
#include "scene/testing/SceneWriters.h"

#include <cmath>
#include <cstring>
#include <fmt/format.h>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;
using namespace std::string_literals;

namespace {

/// Why the file \p Name with \p Content is no scene.
std::string whatIs(const std::string &Content,
                   const std::string &Name = "file") {
  const TestFolder Folder;
  const std::string Path = Folder.write(Name, Content);
  const auto Read = readScene(Path);
  if (Read)
    return fmt::format("read as {}", name(Read->Format));
  EXPECT_EQ(Read.error().Where, Path);
  EXPECT_EQ(Read.error().Code, ExitCode::InputFile);
  return Read.error().What;
}

std::string zipWith(const std::string &Name) { return zipOf({{Name, "x"}}); }

/// \p Start and zeros: three records of a .splat by its length.
std::string record(const std::string &Start) {
  return Start + std::string(96 - Start.size(), '\0');
}

struct Foreign {
  std::string Content;
  const char *Kind; ///< what the message begins with
  const char *Todo; ///< what it says further on
};

TEST(ForeignFile, EachKindIsNamedWithWhatToDo) {
  const Foreign Files[] = {
      {zipWith("archive/data.pkl"), "a checkpoint of PyTorch", "export it"},
      {record("\x80\x02\x8a\x0a\x6c\xfc\x9c\x46\xf9\x20\x6a\xa8\x50\x19"s),
       "a checkpoint of PyTorch", "ns-export"},
      {record("\x80\x02}q"), "a pickle of Python", "export it"},
      {record("\x80\x03}q"), "a pickle of Python", "export it"},
      {record("\x80\x04\x95"), "a pickle of Python", "export it"},
      {record("\x80\x05\x95"), "a pickle of Python", "export it"},
      {record("\x93NUMPY"), "an array of NumPy", "export it"},
      {zipWith("means.npy"), "arrays of NumPy (.npz)", "export it"},
      {record("\x89HDF\r\n\x1a\n"), "an HDF5 file", "export it"},
      {record("\x4b\x67\x00\x00"s), "a .splatv", "one moment"},
      {record("PXR-USDC"), "a USD file", "export them"},
      {"#usda 1.0\n", "a USD file", "export them"},
      {zipWith("scene.usdc"), "a USD file (USDZ)", "export them"},
      {zipWith("scene.usda"), "a USD file (USDZ)", "export them"},
      {zipWith("scene.usd"), "a USD file (USDZ)", "export them"},
      {record("Kaydara FBX Binary  \0"s), "an FBX file", "export them"},
      {"; FBX 7.7.0 project file\n", "an FBX file", "export them"},
      {record("BLENDER-v402"), "a file of Blender", "export them"},
      {record("LASF"), "a point cloud (LAS or LAZ)", "splat train"},
      {record("ASTM-E57"), "a point cloud (E57)", "splat train"},
      {record("DRACO"), "a mesh or point cloud of Draco", "splat train"},
      {"# .PCD v0.7 - Point Cloud Data file format\n", "a point cloud (PCD)",
       "splat train"},
      {"VERSION 0.7\nFIELDS x y z\n", "a point cloud (PCD)", "splat train"},
      {"# Blender\nmtllib a.mtl\nv 1 2 3\n", "a mesh (OBJ)", "splat train"},
      {"o cube\n", "a mesh (OBJ)", "splat train"},
      {"g cube\n", "a mesh (OBJ)", "splat train"},
      {"\r\n# none\r\n\r\nv 1 2 3\r\n", "a mesh (OBJ)", "splat train"},
      {"solid cube\nfacet normal 0 0 1\n", "a mesh (STL)", "splat train"},
      {record("\x89PNG\r\n\x1a\n"), "a picture (PNG)", "splat train"},
      {record("\xff\xd8\xff\xe0"), "a picture (JPEG)", "splat train"},
      {record("\x76\x2f\x31\x01"), "a picture (EXR)", "splat train"},
      {record("RIFF\1\1\1\1WEBP"), "a picture (WebP)", "meta.json"},
      {record("\1\1\1\1ftypisom"), "a video", "splat train"},
      {std::string(257, '\1') + "ustar", "a tar archive", "unpack it"},
      {record("7z\xbc\xaf\x27\x1c"), "a 7z archive", "unpack it"},
      {record("\x28\xb5\x2f\xfd"), "a file packed by zstd", "unpack it"},
      {gzipOf("a log, packed to be kept"), "a gzip-packed file", "gunzip"},
      {zipWith("scene/point_cloud.ply"), "a zip archive without", "unpack it"},
      {zipWith("scene/meta.json"), "a zip archive of a folder", "the folder"},
      {zipWith("lod-meta.json"), "a zip archive of a streamed", "the folder"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n",
       "a pointer of Git LFS", "git lfs pull"},
      {"<!DOCTYPE html>\n<html></html>\n", "a web page", "download"},
      {"[{\"id\": 0, \"img_name\": \"a\"}]", "a list in JSON", "--cameras"},
      {"{\"frames\": []}", "a list of cameras", "--cameras"},
      {"{\"camera_path\": []}", "a camera path", "--cameras"},
      {"{\"keyframes\": []}", "a camera path", "--cameras"},
      {"{\"a\": 1}", "JSON that does not describe a scene", "meta.json"},
      {"{}", "JSON that does not describe a scene", "meta.json"},
      {"0 0 0\n1 1 1\n", "not a scene in a known format", ".spz"},
      // As long as two records of a .splat, and plausible as numbers.
      {std::string(64, '1'), "not a scene in a known format", ".spz"},
  };
  for (const auto &[Content, Kind, Todo] : Files) {
    const std::string What = whatIs(Content);
    EXPECT_TRUE(What.starts_with(Kind)) << Kind << ": " << What;
    EXPECT_NE(What.find(Todo), std::string::npos) << What;
  }
}

TEST(ForeignFile, AnArchiveIsNoSceneUnderAnyName) {
  EXPECT_EQ(whatIs(zipWith("data.pkl"), "a.sog"),
            "a checkpoint of PyTorch, expected a scene of Gaussians; export it "
            "as .ply with the program that trained it (nerfstudio: ns-export "
            "gaussian-splat)");
}

/// \p Start and what makes it a .splat of one Gaussian.
std::string splatBeginning(const std::string &Start) {
  std::string Content = Start + std::string(32 - Start.size(), '\0');
  Content.replace(28, 4, "\xff\x80\x80\x80");
  return Content;
}

TEST(ForeignFile, ASplatMayBeginWithAnyLetter) {
  for (const char *Start : {"{", " {", "[", "<", "v ", "#"})
    EXPECT_EQ(whatIs(splatBeginning(Start)), "read as splat") << Start;
}

TEST(ForeignFile, NumbersWithoutRotationsAreNoSplat) {
  EXPECT_EQ(whatIs(std::string(96, '\0')),
            "3 of 3 records have a rotation that is not normalized, expected a "
            ".splat file, where these are rare");
  // Some writers leave a rotation out here and there.
  const std::string Whole = splatBeginning("");
  EXPECT_EQ(whatIs(Whole + std::string(32, '\0')), "read as splat");
}

} // namespace
