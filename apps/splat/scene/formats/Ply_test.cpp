#include "io/TestFiles.h"
#include "scene/SceneFile.h"
#include "scene/formats/Ply.h"
#include "scene/testing/SceneWriters.h"

#include <cstring>
#include <fmt/format.h>
#include <sstream>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;

namespace {

void expectEqual(const Scene &A, const Scene &B) {
  EXPECT_EQ(A.ShDegree, B.ShDegree);
  EXPECT_EQ(A.Means, B.Means);
  EXPECT_EQ(A.LogScales, B.LogScales);
  EXPECT_EQ(A.Quats, B.Quats);
  EXPECT_EQ(A.OpacityLogits, B.OpacityLogits);
  EXPECT_EQ(A.Sh, B.Sh);
}

Expected<Scene> readPly(const std::string &Path) {
  auto Read = readScene(Path);
  if (!Read)
    return Read.error();
  EXPECT_EQ(Read->Format, SceneFormat::Ply);
  return std::move(Read->Gaussians);
}

/// The error of reading \p Content as a PLY file.
std::string errorOf(const TestFolder &Folder, const std::string &Content) {
  const std::string Path = Folder.write("damaged.ply", Content);
  const auto S = readPly(Path);
  if (S)
    return "";
  EXPECT_EQ(S.error().Code, ExitCode::InputFile);
  EXPECT_TRUE(S.error().Where.starts_with(Path));
  return S.error().What;
}

TEST(Ply, RoundTripsEveryDegree) {
  const TestFolder Folder;
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    // Of degree 0 more than are converted at a time.
    const Scene Written = numberedScene(Degree == 0 ? 70'000 : 5, Degree);
    ASSERT_TRUE(writePly(Folder.path("s.ply"), Written));
    const auto Read = readPly(Folder.path("s.ply"));
    ASSERT_TRUE(Read) << Read.error().What;
    expectEqual(*Read, Written);
  }
}

TEST(Ply, KeepsRestCoefficientsChannelByChannelInTheFile) {
  const TestFolder Folder;
  Scene S = numberedScene(1, 1);
  S.Sh = {0, 0, 0, 1, 4, 7, 2, 5, 8, 3, 6, 9}; // [coefficient][channel]
  ASSERT_TRUE(writePly(Folder.path("s.ply"), S));
  const std::string File = Folder.read("s.ply");
  // After the header: 6 floats of mean and normal, 3 of f_dc, then f_rest.
  const std::size_t Body = File.find("end_header\n") + 11;
  for (int I = 0; I < 9; ++I) {
    float Value;
    std::memcpy(&Value, File.data() + Body + (9 + I) * sizeof(float),
                sizeof(Value));
    EXPECT_EQ(Value, static_cast<float>(I + 1));
  }
}

TEST(Ply, AcceptsAnyPropertyOrderAndSkipsWhatItDoesNotNeed) {
  const TestFolder Folder;
  std::string File = "ply\r\nformat binary_little_endian 1.0\r\n"
                     "comment made by hand\r\nelement vertex 1\r\n";
  const char *Names[] = {"rot_3",   "rot_2",   "f_dc_2", "opacity", "scale_1",
                         "scale_0", "scale_2", "y",      "x",       "z",
                         "rot_0",   "rot_1",   "f_dc_0", "f_dc_1"};
  float Next = 1;
  std::string Body;
  for (const char *Name : Names) {
    File += std::string("property float ") + Name + "\r\n";
    File += std::string("property uchar pad_") + Name + "\r\n";
    Body.append(reinterpret_cast<const char *>(&Next), sizeof(Next));
    Body += 'p';
    Next += 1;
  }
  File += "property double weight\r\nend_header\r\n" + Body + "12345678";
  const auto S = readPly(Folder.write("s.ply", File));
  ASSERT_TRUE(S) << S.error().What;
  EXPECT_EQ(S->Means, (std::vector<float>{9, 8, 10}));
  EXPECT_EQ(S->LogScales, (std::vector<float>{6, 5, 7}));
  EXPECT_EQ(S->Quats, (std::vector<float>{11, 12, 2, 1}));
  EXPECT_EQ(S->OpacityLogits, (std::vector<float>{4}));
  EXPECT_EQ(S->Sh, (std::vector<float>{13, 14, 3}));
}

TEST(Ply, TextBigEndianAndDoublesAreTheSameScene) {
  const TestFolder Folder;
  const Scene Written = numberedScene(3, 1);
  const std::string Binary = formatPly(Written);
  const std::size_t Body = Binary.find("end_header\n") + 11;
  const auto Named = [&](const std::string &Format, const std::string &Type) {
    std::string Header = Binary.substr(0, Body);
    Header.replace(Header.find("binary_little_endian"), 20, Format);
    for (std::size_t At = 0;
         (At = Header.find("property float", At)) != std::string::npos; ++At)
      Header.replace(At, 14, "property " + Type);
    return Header;
  };
  std::string Text = Named("ascii", "float");
  std::string Big = Named("binary_big_endian", "float");
  std::string Doubles = Named("binary_little_endian", "double");
  for (std::size_t At = Body; At < Binary.size(); At += sizeof(float)) {
    float Value;
    std::memcpy(&Value, Binary.data() + At, sizeof(Value));
    Text += fmt::format("{}{}", Value, At % 3 == 0 ? "\n" : " ");
    Big += {Binary.rend() - static_cast<std::ptrdiff_t>(At + 4),
            Binary.rend() - static_cast<std::ptrdiff_t>(At)};
    const double Wide = Value;
    Doubles.append(reinterpret_cast<const char *>(&Wide), sizeof(Wide));
  }
  for (const std::string *Each : {&Text, &Big, &Doubles}) {
    const std::string &File = *Each;
    const auto Read = readPly(Folder.write("s.ply", File));
    ASSERT_TRUE(Read) << Read.error().What;
    expectEqual(*Read, Written);
    // The last number of a text may be cut and still be one.
    const std::size_t Last = &File == &Text
                                 ? File.find_last_of(" \n", File.size() - 2)
                                 : File.size();
    for (std::size_t Size = 0; Size < Last; ++Size)
      EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(File.data(), Size))))
          << Size << " bytes";
  }
}

TEST(Ply, DoublesKeepWhatFp32Loses) {
  const TestFolder Folder;
  std::string Header = formatPly(numberedScene(1, 0));
  Header.resize(Header.find("end_header\n") + 11);
  Header.replace(Header.find("binary_little_endian"), 20, "ascii");
  for (const char *Each : {"float x", "float y", "float z"})
    Header.replace(Header.find(Each), 5, "double");
  const auto Read = readPly(Folder.write(
      "s.ply", Header + "412345.678901 5654321.25 120 0 0 0 0 0 0 0 0 0 0 1 0 "
                        "0 0\n"));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Means, (std::vector<float>{412345.678901F, 5654321, 120}));
  EXPECT_EQ(Read->mean(0), 412345.678901);
  EXPECT_EQ(Read->mean(1), 5654321.25);
  EXPECT_EQ(Read->mean(2), 120);
}

TEST(Ply, OtherElementsAreNamedAndSkipped) {
  const TestFolder Folder;
  const Scene Written = numberedScene(2, 0);
  std::string File = formatPly(Written);
  File.insert(File.find("end_header"), "element extrinsic 2\n"
                                       "property float extrinsic\n"
                                       "element face 1\n"
                                       "property list uchar int corners\n");
  File += std::string(8, 'e') + std::string("\1abcd");
  const auto Read = readScene(Folder.write("s.ply", File));
  ASSERT_TRUE(Read) << Read.error().What;
  expectEqual(Read->Gaussians, Written);
  EXPECT_EQ(Read->Skipped,
            (std::vector<std::string>{"element extrinsic", "element face"}));
}

TEST(Ply, PropertiesThatWouldChangeThePictureAreRefusedOthersNamed) {
  const TestFolder Folder;
  const std::string File = formatPly(numberedScene(2, 0));
  const auto With = [&](const std::string &Name) {
    std::string Changed = File;
    Changed.replace(Changed.find("float nx"), 8, "float " + Name);
    return Changed;
  };
  EXPECT_EQ(errorOf(Folder, With("filter_3D")),
            "property filter_3D of element vertex requires Mip-Splatting's 3D "
            "filter, which is not supported");
  EXPECT_NE(errorOf(Folder, With("trbf_center")).find("motion over time"),
            std::string::npos);
  const auto Plain = readScene(Folder.write("s.ply", File));
  ASSERT_TRUE(Plain);
  EXPECT_TRUE(Plain->Skipped.empty());
  const auto Labelled = readScene(Folder.write("s.ply", With("label")));
  ASSERT_TRUE(Labelled);
  EXPECT_EQ(Labelled->Skipped, std::vector<std::string>{"label"});
}

/// A PLY of text with one vertex.
std::string oneVertex(const std::string &Properties, const std::string &Row) {
  return "ply\nformat ascii 1.0\nelement vertex 1\n" + Properties +
         "end_header\n" + Row + "\n";
}

std::string floats(const std::string &Names) {
  std::string Lines, Name;
  for (std::istringstream In(Names); In >> Name;)
    Lines += "property float " + Name + "\n";
  return Lines;
}

const std::string Colours =
    "property uchar red\nproperty uchar green\nproperty uchar blue\n";

// As nerfstudio's ns-export gaussian-splat --ply-color-mode rgb writes it.
TEST(Ply, ColoursMayBeBytes) {
  const TestFolder Folder;
  const std::string Before = floats("x y z nx ny nz");
  const std::string After =
      floats("opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3");
  const auto S = readPly(Folder.write(
      "s.ply", oneVertex(Before + Colours + After, "1 2 3 0 0 0 0 255 51 "
                                                   "4 5 6 7 1 0 0 0")));
  ASSERT_TRUE(S) << S.error().What;
  EXPECT_EQ(S->ShDegree, 0);
  EXPECT_EQ(S->OpacityLogits, std::vector<float>{4});
  EXPECT_EQ(S->LogScales, (std::vector<float>{5, 6, 7}));
  const double Expected[] = {-0.5, 0.5, -0.3};
  for (std::size_t C = 0; C < 3; ++C)
    EXPECT_NEAR(S->Sh[C], Expected[C] / ShC0, 1e-6);
}

TEST(Ply, ColoursOfOtherTypesDoNotStandForHarmonics) {
  const TestFolder Folder;
  const std::string Rest =
      floats("x y z opacity scale_0 scale_1 scale_2 rot_0 rot_1 rot_2 rot_3");
  const std::string Row = "1 2 3 4 5 6 7 1 0 0 0 1 1 1";
  EXPECT_EQ(errorOf(Folder, oneVertex(Rest + floats("red green blue"), Row)),
            "property f_dc_0 of element vertex is missing, expected a float or "
            "double");
  std::string Mixed = Colours;
  Mixed.replace(Mixed.find("uchar blue"), 5, "float");
  EXPECT_EQ(errorOf(Folder, oneVertex(Rest + Mixed, Row)),
            "property blue of element vertex has another type, expected uchar");
}

TEST(Ply, PointCloudsAndMeshesAreNamed) {
  const TestFolder Folder;
  const std::string Points =
      oneVertex(floats("x y z") + Colours, "0 0 0 255 255 255");
  EXPECT_EQ(errorOf(Folder, Points),
            "a point cloud: element vertex has no opacity, scale_0 or rot_0, "
            "expected a scene of Gaussians; `splat train` makes one from "
            "photographs whose cameras are known");
  std::string Mesh = Points + "3 0 0 0\n";
  Mesh.insert(Mesh.find("end_header"),
              "element face 1\nproperty list uchar int vertex_indices\n");
  EXPECT_TRUE(errorOf(Folder, Mesh).starts_with("a mesh: "));
}

TEST(Ply, EveryTruncationIsAnError) {
  const TestFolder Folder;
  ASSERT_TRUE(writePly(Folder.path("s.ply"), numberedScene(2, 0)));
  const std::string File = Folder.read("s.ply");
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_NE(errorOf(Folder, File.substr(0, Size)), "") << Size << " bytes";
  EXPECT_NE(errorOf(Folder, File + "x").find("1 byte after the last element"),
            std::string::npos);
}

TEST(Ply, EveryDamagedHeaderByteIsReadOrRefusedButNeverACrash) {
  const TestFolder Folder;
  ASSERT_TRUE(writePly(Folder.path("s.ply"), numberedScene(2, 0)));
  const std::string File = Folder.read("s.ply");
  const std::size_t Header = File.find("end_header\n") + 11;
  std::size_t Refused = 0;
  for (std::size_t At = 0; At < Header; ++At)
    for (const char Byte : {'\0', '\n', ' ', '9', '-', '\xff'}) {
      std::string Damaged = File;
      Damaged[At] = Byte;
      Refused += !readPly(Folder.write("damaged.ply", Damaged));
    }
  // Only the names of the skipped normals and single separators may change.
  EXPECT_GT(Refused, Header * 5);
}

TEST(Ply, FoldersAndMissingFilesAreErrors) {
  const TestFolder Folder;
  EXPECT_FALSE(readPly(Folder.path("absent.ply")));
  EXPECT_FALSE(readPly(Folder.path("")));
  EXPECT_FALSE(writePly(Folder.path("absent/s.ply"), numberedScene(1, 0)));
}

} // namespace
