// Meshes of each format, and what is refused, by file and place.
#include "mesh/Mesh.h"

#include "io/PhotoFile.h"
#include "scene/formats/GltfWriter.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

using namespace vorion;
using namespace vorion::splat;

namespace {

Bytes bytes(const std::string &Text) { return std::as_bytes(std::span(Text)); }

using Reader = Expected<Mesh> (*)(const std::string &, Bytes);

std::string errorOf(Reader Read, const std::string &Text) {
  const auto M = Read("file", bytes(Text));
  if (M)
    return "";
  EXPECT_EQ(M.error().Code, ExitCode::InputFile);
  return M.error().Where + ": " + M.error().What;
}

/// Whether \p Read refuses \p Text with a message that begins with \p Message.
testing::AssertionResult refuses(Reader Read, const std::string &Text,
                                 const std::string &Message) {
  const std::string Is = errorOf(Read, Text);
  return Is.starts_with(Message) ? testing::AssertionSuccess()
                                 : testing::AssertionFailure() << Is;
}

TEST(ObjMesh, FacesOfAnySizeAndNumbering) {
  const auto M = readObjMesh("file", bytes("# a comment\n"
                                           "o thing\n"
                                           "v 0 0 0 1 0 0.5\r\n"
                                           "v 1 0 0\n"
                                           "v 1 \\\n 1 0\n"
                                           "v 0 1 0 1.0\n"
                                           "vt 0 0\nvn 0 0 1\n"
                                           "usemtl\nf 1/1/1 2//1 3 4/1\n"
                                           "f -4 -3 -2\n"));
  ASSERT_TRUE(M) << M.error().What;
  ASSERT_EQ(M->Parts.size(), 1U);
  EXPECT_EQ(M->Parts[0].Name, "thing");
  EXPECT_EQ(M->vertices(), 4U);
  EXPECT_EQ(M->Corners, (std::vector<uint32_t>{0, 1, 2, 0, 2, 3, 0, 1, 2}));
  EXPECT_EQ(M->Colors[2], 0.5F);
  EXPECT_EQ(M->Colors[4], 1.0F);
}

/// A folder for files that name each other.
class ObjFiles : public testing::Test {
protected:
  ObjFiles()
      : Folder(testing::TempDir() + "/obj-" +
               testing::UnitTest::GetInstance()->current_test_info()->name()) {
    std::filesystem::remove_all(Folder);
    std::filesystem::create_directory(Folder);
  }
  ~ObjFiles() override { std::filesystem::remove_all(Folder); }

  void write(const std::string &Name, const std::string &Text) const {
    std::ofstream(Folder + "/" + Name, std::ios::binary) << Text;
  }
  Expected<Mesh> read(const std::string &Text) const {
    return readObjMesh(Folder + "/m.obj", bytes(Text));
  }

  std::string Folder;
};

constexpr const char *Triangle = "v 0 0 0\nv 1 0 0\nv 1 1 0\n"
                                 "vt 0 0\nvt 1 0\nvt 1 0.75\nvn 0 0 2\n";

/// A red pixel over a blue one, as a WebP.
std::string twoPixels() {
  const unsigned char Rgb[] = {255, 0, 0, 0, 0, 255};
  auto File = encodeWebP(Rgb, 1, 2, std::nullopt);
  EXPECT_TRUE(File);
  return *File;
}

TEST_F(ObjFiles, WhatIsMissingIsDrawnGreyWithAWarning) {
  const auto M = read("mtllib none.mtl\n" + std::string(Triangle) +
                      "usemtl wood\nf 1 2 3\n");
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(M->Colors, (std::vector<float>{0.4F, 0.4F, 0.4F, 1, 0.4F, 0.4F,
                                           0.4F, 1, 0.4F, 0.4F, 0.4F, 1}));
  ASSERT_EQ(M->Warnings.size(), 2U);
  EXPECT_EQ(M->Warnings[0].Where, Folder + "/m.obj:1");
  EXPECT_EQ(M->Warnings[0].What,
            "no file " + Folder + "/none.mtl: its materials are drawn grey");
  EXPECT_EQ(M->Warnings[1].What,
            "material `wood` is in no library and drawn grey");
  // Colours of the vertices are kept.
  const auto Own = read("v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\n"
                        "usemtl wood\nf 1 2 3\n");
  ASSERT_TRUE(Own) << Own.error().What;
  EXPECT_EQ(Own->Colors[0], 1);
  EXPECT_EQ(Own->Colors[1], 0);
  // A missing picture, too.
  write("m.mtl", "newmtl a\nKd 0.5 1 1\nmap_Kd none.png\n");
  const auto Bare = read("mtllib m.mtl\n" + std::string(Triangle) +
                         "usemtl a\nf 1/1 2/2 3/3\n");
  ASSERT_TRUE(Bare) << Bare.error().What;
  EXPECT_FALSE(Bare->hasTextures());
  EXPECT_EQ(Bare->Colors[0], 0.5F);
  ASSERT_EQ(Bare->Warnings.size(), 1U);
  EXPECT_EQ(Bare->Warnings[0].Where, Folder + "/m.mtl:3");
}

TEST_F(ObjFiles, OpaqueAsManyProgramsWriteIt) {
  for (const auto &[Line, Alpha] : {std::pair("Tr 1.000000", 1.0F),
                                    {"Tr 0", 1.0F},
                                    {"d 1", 1.0F},
                                    {"d -halo 1.0", 1.0F},
                                    {"Tr 0.25", 0.75F},
                                    {"d 0.5", 0.5F}}) {
    write("my m.mtl", std::string("newmtl my a\n") + Line + "\n");
    const auto M = read("mtllib my m.mtl\n" + std::string(Triangle) +
                        "usemtl my a\nf 1 2 3\n");
    ASSERT_TRUE(M) << Line << M.error().What;
    EXPECT_TRUE(M->Warnings.empty()) << Line;
    EXPECT_EQ(M->has(AlphaMode::Blend), Alpha < 1) << Line;
    EXPECT_EQ(M->Colors[3], Alpha) << Line;
  }
}

TEST_F(ObjFiles, TexturesHaveTheirCoordinatesFromTheTop) {
  write("a b.webp", twoPixels());
  write("m.mtl", "newmtl a\nmap_Kd -s 2 1 1 -o 0.25 0 -clamp on a b.webp\n");
  const auto M = read("mtllib m.mtl\n" + std::string(Triangle) +
                      "f 1 2 3\nusemtl a\nf 1/1/1 2/2/1 3/3/1\n");
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(
      M->TextureCoordinates,
      (std::vector<float>{0, 0, 0, 0, 0, 0, 0.25F, 1, 2.25F, 1, 2.25F, 0.25F}));
  EXPECT_EQ(M->Normals[9 + 2], 2);
  EXPECT_EQ(M->Normals[2], 0);
  ASSERT_EQ(M->Textures.size(), 1U);
  EXPECT_EQ(M->Textures[0].Levels.size(), 2U);
  const Material &Look = M->Materials[M->MaterialOf[1]];
  EXPECT_EQ(Look.Picture, 0U);
  EXPECT_EQ(Look.Sampling.Wraps[0], Wrap::Clamp);
  EXPECT_EQ(M->Materials[M->MaterialOf[0]].Picture, std::nullopt);
}

TEST_F(ObjFiles, AMeshInAGlbIsReadAgain) {
  write("a.webp", twoPixels());
  write("m.mtl", "newmtl a\nmap_Kd -clamp on a.webp\nnewmtl b\nKd 0.5 1 0\nd "
                 "0.5\n");
  const auto M = read("mtllib m.mtl\n" + std::string(Triangle) +
                      "usemtl a\nf 1/1/1 2/2/1 3/3/1\nusemtl b\nf 3 2 1\n");
  ASSERT_TRUE(M) << M.error().What;
  Mesh Twice = *M;
  Twice.append(*M);
  Twice.Parts[1].Name = "the second";
  EXPECT_EQ(Twice.Corners[6], M->vertices());
  EXPECT_EQ(Twice.Materials[Twice.MaterialOf[2]].Picture, 1U);
  GltfWriter To;
  addMesh(To, Twice);
  const auto File = To.finish();
  ASSERT_TRUE(File) << File.error().What;
  EXPECT_TRUE(isMeshFile(bytes(*File)));
  const auto Read = readGltfMesh("file", bytes(*File));
  ASSERT_TRUE(Read) << Read.error().What;
  ASSERT_EQ(Read->triangles(), 4U);
  EXPECT_EQ(Read->partOf(1).Name, "mesh 0");
  EXPECT_EQ(Read->partOf(2).Name, "the second");
  EXPECT_EQ(Read->TextureCoordinates, Twice.TextureCoordinates);
  EXPECT_EQ(Read->Normals, Twice.Normals);
  for (std::size_t I = 0; I < Twice.Corners.size(); ++I) {
    const uint32_t A = Read->Corners[I], B = Twice.Corners[I];
    for (std::size_t K = 0; K < 3; ++K)
      EXPECT_EQ(Read->Positions[3 * A + K], Twice.Positions[3 * B + K]);
    for (std::size_t K = 0; K < 4; ++K)
      EXPECT_NEAR(Read->Colors[4 * A + K], Twice.Colors[4 * B + K], 1e-6);
  }
  ASSERT_EQ(Read->Textures.size(), 2U);
  EXPECT_EQ(Read->Textures[1].Texels, M->Textures[0].Texels);
  for (std::size_t T = 0; T < 4; ++T) {
    const Material &A = Read->Materials[Read->MaterialOf[T]],
                   &B = Twice.Materials[Twice.MaterialOf[T]];
    EXPECT_EQ(A.Picture, B.Picture);
    EXPECT_EQ(A.Alpha, B.Alpha);
    EXPECT_EQ(A.Sampling, B.Sampling);
  }
}

TEST_F(ObjFiles, TrianglesKeepTheirFileAndNumber) {
  write("m.obj", std::string(Triangle) + "o a\no b\nf 1 2 3\nf 1 3 2\no c\n"
                                         "f 3 2 1\no d\n");
  const auto M = readMesh(Folder + "/m.obj");
  ASSERT_TRUE(M) << M.error().What;
  Mesh All = *M;
  All.append(*M);
  ASSERT_EQ(All.Parts.size(), 4U);
  const MeshPart &Last = All.partOf(5);
  EXPECT_EQ(Last.Name, "c");
  EXPECT_EQ(Last.File, Folder + "/m.obj");
  EXPECT_EQ(Last.First, 5U);
  EXPECT_EQ(Last.Number, 2U);
  EXPECT_EQ(All.partOf(4).Name, "b");
  EXPECT_EQ(All.partOf(4).Number, 0U);
}

TEST_F(ObjFiles, PlacesChangeWithNormals) {
  auto M = read(std::string(Triangle) + "f 1//1 2//1 3//1\n");
  ASSERT_TRUE(M) << M.error().What;
  // A quarter turn about x takes y to z.
  transform(*M, {.Scale = 2,
                 .Rotation = rotationOf({90, 0, 0}),
                 .Translation = {0.5, 0, -8}});
  for (std::size_t A = 0; A < 3; ++A) {
    EXPECT_NEAR(M->Positions[6 + A], (std::array{2.5, 0.0, -6.0}[A]), 1e-6);
    EXPECT_NEAR(M->Normals[A], (std::array{0.0, -2.0, 0.0}[A]), 1e-6);
  }
  changeAxes(*M, {.From = {1, 1, 1}, .To = {1, -1, -1}});
  EXPECT_NEAR(M->Positions[8], 6, 1e-6);
  EXPECT_NEAR(M->Normals[1], 2, 1e-6);
  const auto First = std::make_shared<const Mesh>(*M);
  EXPECT_EQ(joined(nullptr, nullptr, {}), nullptr);
  EXPECT_EQ(joined(nullptr, First, {}), First);
  const auto Both = joined(First, First, {0, 0, 4});
  EXPECT_EQ(Both->triangles(), 2U);
  EXPECT_NEAR(Both->Positions[8], 2, 1e-6);
}

TEST_F(ObjFiles, DamagedPicturesAreRefusedByName) {
  const std::string Obj =
      "mtllib m.mtl\n" + std::string(Triangle) + "usemtl a\nf 1/1 2/2 3/3\n";
  write("m.mtl", "newmtl a\nmap_Kd a.webp\n");
  write("a.webp", twoPixels().substr(0, 30));
  const auto Cut = read(Obj);
  ASSERT_FALSE(Cut);
  EXPECT_EQ(Cut.error().Where, Folder + "/a.webp");
  write("a.webp", "hello");
  EXPECT_FALSE(read(Obj));
  // The header of a PNG of 2^31 - 1 texels a side.
  std::string Png(
      "\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff"
      "\x08\x02\0\0\0\0\0\0\0",
      33);
  write("a.webp", Png);
  const auto Huge = read(Obj);
  ASSERT_FALSE(Huge);
  EXPECT_EQ(Huge.error().Where, Folder + "/a.webp");
  EXPECT_EQ(Huge.error().Code, ExitCode::InputFile);
}

TEST(Texture, LevelsAreMeansInLinearLight) {
  const auto T = decodeTexture("t", bytes(twoPixels()));
  ASSERT_TRUE(T) << T.error().What;
  ASSERT_EQ(T->Levels.size(), 2U);
  EXPECT_EQ(T->Texels[0], 0xFF0000FFU);
  EXPECT_EQ(T->Texels[1], 0xFFFF0000U);
  // Half of the light is 188 of 255.
  EXPECT_EQ(T->Texels[2], 0xFFBC00BCU);
  // Of three texels, one and a half each, down to one.
  const unsigned char Rgb[] = {255, 255, 255, 255, 255, 255, 0, 0, 0};
  const auto Third = encodeWebP(Rgb, 3, 1, std::nullopt);
  ASSERT_TRUE(Third);
  const auto Odd = decodeTexture("t", bytes(*Third));
  ASSERT_TRUE(Odd) << Odd.error().What;
  ASSERT_EQ(Odd->Levels.size(), 2U);
  // Two thirds of the light.
  const auto Mean =
      static_cast<uint32_t>(std::lround(255 * fromLinear(2.0 / 3)));
  EXPECT_EQ(Odd->Texels[3], 0xFF000000U | Mean << 16 | Mean << 8 | Mean);
}

TEST(ObjMesh, WhatIsRefused) {
  const std::string V = "v 0 0 0\nv 1 0 0\nv 1 1 0\n";
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2 4\n", "file:4: vertex 4,"));
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2 0\n", "file:4: vertex 0,"));
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2 -4\n", "file:4: vertex -4,"));
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2 99999999999999999999\n",
                      "file:4: vertex 99999999999999999999,"));
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2\n", "file:4: a face of 2"));
  EXPECT_TRUE(refuses(readObjMesh, V + "f 1 2 x\n", "file:4: `x`"));
  EXPECT_TRUE(refuses(readObjMesh, "v 0 nan 0\n", "file:1: `nan`"));
  EXPECT_TRUE(refuses(readObjMesh, "v 0 1e39 0\n", "file:1: `1e39`"));
  EXPECT_TRUE(refuses(readObjMesh, "v 0 0\n", "file:1: a vertex of 2"));
  EXPECT_TRUE(refuses(readObjMesh, "v 0 0 0 1 2 1\n", "file:1: a colour of 2"));
  EXPECT_TRUE(refuses(readObjMesh, "\n\nhello there\n", "file:3: `hello`"));
  EXPECT_TRUE(refuses(readObjMesh, V + "vt 0 0\nf 1/2 2/1 3/1\n",
                      "file:5: texture coordinate 2,"));
}

constexpr const char *PlyHead = "ply\nformat ascii 1.0\nelement vertex 3\n"
                                "property float x\nproperty float y\n"
                                "property float z\nproperty uchar red\n"
                                "property uchar green\nproperty uchar blue\n"
                                "element face 1\n";

TEST(PlyMesh, ListsOfFaces) {
  const std::string Vertices = "0 0 0 255 0 51\n1 0 0 0 0 0\n1 1 0 0 0 0\n";
  const auto M =
      readPlyMesh("file", bytes(std::string(PlyHead) +
                                "property uchar flags\n"
                                "property list uchar int vertex_indices\n"
                                "property list int float others\nend_header\n" +
                                Vertices + "7 4 0 1 2 0 1 0.5\n"));
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(M->Corners, (std::vector<uint32_t>{0, 1, 2, 0, 2, 0}));
  EXPECT_EQ(M->Colors[2], 0.2F);
  const std::string Rest = "property list uchar int vertex_index\nend_header\n";
  EXPECT_TRUE(refuses(readPlyMesh, PlyHead + Rest + Vertices + "3 0 1 3\n",
                      "file: face 0 has vertex 3"));
  EXPECT_TRUE(refuses(readPlyMesh, PlyHead + Rest + Vertices + "3 0 1 -1\n",
                      "file: face 0 has vertex -1"));
  EXPECT_TRUE(refuses(readPlyMesh, PlyHead + Rest + Vertices + "2 0 1\n",
                      "file: face 0 has 2 corners"));
  EXPECT_TRUE(refuses(readPlyMesh,
                      PlyHead + Rest +
                          "0 0 nan 0 0 0\n0 0 0 0 0 0\n0 0 0 0 0 "
                          "0\n3 0 1 2\n",
                      "file: vertex 0 is at nan"));
  EXPECT_TRUE(refuses(readPlyMesh,
                      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float "
                      "x\nproperty float y\nproperty float z\nend_header\n0 0 "
                      "0\n",
                      "file: no element face"));
}

TEST(PlyMesh, ATextureIsAWarning) {
  std::string Text = std::string(PlyHead) +
                     "property list uchar int vertex_indices\nend_header\n"
                     "0 0 0 255 0 51\n1 0 0 0 0 0\n1 1 0 0 0 0\n3 0 1 2\n";
  Text.insert(4, "comment TextureFile wood.png\ncomment made by hand\n");
  const auto M = readPlyMesh("file", bytes(Text));
  ASSERT_TRUE(M) << M.error().What;
  ASSERT_EQ(M->Warnings.size(), 1U);
  EXPECT_EQ(M->Warnings[0].Where, "file");
  EXPECT_EQ(M->Warnings[0].What, "drawn without the texture wood.png, expected "
                                 "an OBJ or glTF file with it");
}

std::string bigEndian(const std::string &Encoding) {
  std::string Text = "ply\nformat " + Encoding +
                     " 1.0\nelement face 1\n"
                     "property list ushort ushort vertex_indices\n"
                     "element vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nend_header\n";
  const auto Put = [&](auto Value) {
    std::string Word(reinterpret_cast<const char *>(&Value), sizeof(Value));
    if (Encoding == "binary_big_endian")
      std::ranges::reverse(Word);
    Text += Word;
  };
  for (const uint16_t V : {3, 2, 1, 0})
    Put(V);
  for (const float V : {0.0F, 1.0F, 2.0F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F, 8.0F})
    Put(V);
  return Text;
}

TEST(PlyMesh, BinaryOfBothByteOrders) {
  for (const char *Encoding : {"binary_little_endian", "binary_big_endian"}) {
    const std::string Text = bigEndian(Encoding);
    const auto M = readPlyMesh("file", bytes(Text));
    ASSERT_TRUE(M) << M.error().What;
    EXPECT_EQ(M->Corners, (std::vector<uint32_t>{2, 1, 0}));
    EXPECT_EQ(M->Positions[5], 5.0F);
  }
}

/// Three vertices, three indices of a byte, and a material.
std::string gltf(const std::string &Material, const std::string &Mode = "4",
                 const std::string &Last = "Ag==") {
  // 9 floats 0 0 0 1 0 0 0 1 0, then bytes 0 1 and the last.
  return R"({"asset": {"version": "2.0"}, "scene": 0,
 "scenes": [{"nodes": [0]}],
 "nodes": [{"mesh": 0, "translation": [10, 0, 0], "scale": [2, 1, 1]}],
 "materials": [)" +
         Material + R"(],
 "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1,
   "material": 0, "mode": )" +
         Mode +
         R"(}]}],
 "accessors": [
  {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
  {"bufferView": 1, "componentType": 5121, "count": 3, "type": "SCALAR"}],
 "bufferViews": [{"buffer": 0, "byteLength": 36},
                 {"buffer": 1, "byteLength": 3}],
 "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)"
         "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"
         R"("}, {"byteLength": 3,
  "uri": "data:application/octet-stream;base64,)" +
         Last + R"("}]})";
}

TEST(GltfMesh, NodesMaterialsAndEncoding) {
  const auto M = readGltfMesh("file", bytes(gltf(R"({"pbrMetallicRoughness":
                          {"baseColorFactor": [1, 0.2140411, 0, 1]}})",
                                                 "4", "AAEC")));
  ASSERT_TRUE(M) << M.error().What;
  EXPECT_EQ(M->Corners, (std::vector<uint32_t>{0, 1, 2}));
  EXPECT_EQ(M->Positions[3], 12.0F);
  EXPECT_EQ(M->Colors[0], 1.0F);
  EXPECT_NEAR(M->Colors[1], 0.5F, 1e-5);
}

TEST(GltfMesh, WhatIsRefused) {
  const std::string P = "file: mesh 0 primitive 0: ";
  EXPECT_TRUE(
      refuses(readGltfMesh, gltf("{}", "4", "AAED"), P + "index 2 is 3,"));
  EXPECT_TRUE(refuses(readGltfMesh, gltf("{}", "1", "AAEC"), P + "mode 1"));
  EXPECT_TRUE(refuses(readGltfMesh,
                      gltf(R"({"alphaMode": "GLOW"})", "4", "AAEC"),
                      P + "material 0 has alphaMode"));
  const std::string Textured =
      R"({"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";
  EXPECT_TRUE(refuses(readGltfMesh, gltf(Textured, "4", "AAEC"),
                      "file: material 0: no object 0 in textures"));
  const auto With = [&](const std::string &Lists) {
    std::string Text = gltf(Textured, "4", "AAEC");
    return Text.insert(1, Lists);
  };
  EXPECT_TRUE(refuses(readGltfMesh, With(R"("textures": [{}],)"),
                      "file: material 0: its texture has no source"));
  EXPECT_TRUE(refuses(
      readGltfMesh,
      With(R"("textures": [{"source": 0}], "images": [{"uri": "none.png"}],)"),
      "none.png: "));
  EXPECT_TRUE(refuses(readGltfMesh, With(R"("textures": [{"source": 0}],
 "images": [{"uri": "data:image/png;base64,AAEC"}],)"),
                      "file: image 0: "));
}

} // namespace
