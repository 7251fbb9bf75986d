#include "scene/formats/Gltf.h"

#include "io/TestFiles.h"
#include "scene/Axes.h"
#include "scene/Edit.h"
#include "scene/testing/Compare.h"
#include "scene/testing/SceneWriters.h"

#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

using namespace vorion;
using namespace vorion::splat;
using namespace vorion::splat::testing;
using Json = nlohmann::json;

namespace {

Scene parsed(const std::string &Content) {
  return parsedAs(SceneFormat::Gltf, Content).Gaussians;
}

/// \p P with its text changed.
std::string changed(const GltfParts &P,
                    const std::function<void(Json &)> &Change) {
  Json J = Json::parse(P.Text);
  Change(J);
  return glbOf({J.dump(), P.Buffer});
}

void expectSame(const Scene &Read, const Scene &Wanted) {
  ASSERT_EQ(Read.size(), Wanted.size());
  ASSERT_EQ(Read.ShDegree, Wanted.ShDegree);
  const auto D = differencesOf(Read, Wanted);
  EXPECT_LE(D.Position, 1e-5);
  EXPECT_LE(D.LogScale, 2e-6);
  EXPECT_LE(D.Rotation, 1e-6);
  EXPECT_LE(D.Opacity, 1e-6);
  EXPECT_LE(D.Color, 1e-6);
  EXPECT_LE(D.Harmonics, 2e-6);
}

std::string base64Of(const std::string &Bytes) {
  constexpr char Digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvw"
                            "xyz0123456789+/";
  std::string Out;
  for (std::size_t I = 0; I < Bytes.size(); I += 3) {
    uint32_t Bits = 0;
    for (std::size_t K = 0; K < 3; ++K)
      Bits = Bits << 8 |
             (I + K < Bytes.size() ? static_cast<uint8_t>(Bytes[I + K]) : 0U);
    for (std::size_t K = 0; K < 4; ++K)
      Out += I + K > Bytes.size() ? '=' : Digits[Bits >> (18 - 6 * K) & 63];
  }
  return Out;
}

TEST(Gltf, ValuesAreThoseThatWereWritten) {
  for (int Degree = 0; Degree <= MaxShDegree; ++Degree) {
    const Scene S = randomScene(20, Degree, 3);
    const Scene Read = parsed(glbOf(gltfOf(S)));
    expectSame(Read, S);
    EXPECT_EQ(Read.Means, S.Means);
    EXPECT_EQ(Read.Sh, S.Sh);
  }
}

TEST(Gltf, BuffersMayBeFilesOrData) {
  const Scene S = randomScene(7, 1, 3);
  const TestFolder Folder;
  const GltfParts Beside = gltfOf(S, "my%20buffer.bin");
  Folder.write("my buffer.bin", Beside.Buffer);
  Folder.write("s.gltf", Beside.Text);
  const auto Read = readScene(Folder.path("s.gltf"));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Format, SceneFormat::Gltf);
  EXPECT_EQ(Read->Gaussians.Means, S.Means);
  const std::string Data =
      "data:application/octet-stream;base64," + base64Of(Beside.Buffer);
  EXPECT_EQ(parsed(gltfOf(S, Data).Text).Sh, S.Sh);
  // Of another folder, and where no folder is known.
  Folder.write("t.gltf", gltfOf(S, "../secret.bin").Text);
  EXPECT_NE(readScene(Folder.path("t.gltf")).error().What.find("../secret.bin"),
            std::string::npos);
  EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(Beside.Text))));
}

TEST(Gltf, NodesMoveTurnAndScale) {
  const Scene S = randomScene(20, 3, 3);
  Scene Moved = S;
  transform(Moved, {2, rotationOf({0, 90, 0}), {1, 2, 3}});
  const double H = std::sqrt(0.5);
  const Json Node{{"translation", {1, 2, 3}},
                  {"rotation", {0, H, 0, H}},
                  {"scale", {2, 2, 2}}};
  expectSame(parsed(glbOf(gltfOf(S, "", Node.dump()))), Moved);
  const Json Matrix{
      {"matrix", {0, 0, -2, 0, 0, 2, 0, 0, 2, 0, 0, 0, 1, 2, 3, 1}}};
  expectSame(parsed(glbOf(gltfOf(S, "", Matrix.dump()))), Moved);
  // The same by two nodes, one in the other.
  const auto Nested = changed(gltfOf(S), [&](Json &J) {
    J["nodes"] = {
        {{"translation", {1, 2, 3}}, {"children", {1}}},
        {{"rotation", {0, H, 0, H}}, {"scale", {2, 2, 2}}, {"mesh", 0}}};
  });
  expectSame(parsed(Nested), Moved);
}

/// Entry of the covariance of Gaussian \p I.
double covariance(const Scene &S, std::size_t I, std::size_t R, std::size_t C) {
  const float *Q = &S.Quats[4 * I];
  const double N = 2 / (double(Q[0]) * Q[0] + double(Q[1]) * Q[1] +
                        double(Q[2]) * Q[2] + double(Q[3]) * Q[3]);
  const double W = Q[0], X = Q[1], Y = Q[2], Z = Q[3];
  const double M[3][3] = {
      {1 - N * (Y * Y + Z * Z), N * (X * Y - W * Z), N * (X * Z + W * Y)},
      {N * (X * Y + W * Z), 1 - N * (X * X + Z * Z), N * (Y * Z - W * X)},
      {N * (X * Z - W * Y), N * (Y * Z + W * X), 1 - N * (X * X + Y * Y)}};
  double Sum = 0;
  for (std::size_t K = 0; K < 3; ++K)
    Sum += M[R][K] * M[C][K] * std::exp(2.0 * S.LogScales[3 * I + K]);
  return Sum;
}

/// A node's matrix, glTF's by columns, without a translation.
Json matrixOf(const double (&Rows)[3][3]) {
  Json M = Json::array();
  for (std::size_t C = 0; C < 3; ++C) {
    for (const auto &Row : Rows)
      M.push_back(Row[C]);
    M.push_back(0);
  }
  for (const double Last : {0, 0, 0, 1})
    M.push_back(Last);
  return {{"matrix", M}};
}

TEST(Gltf, CovariancesGoThroughAnyMatrix) {
  const double Matrices[][3][3] = {
      {{0.5, 0, 0}, {0, 3, 0}, {0, 0, 1}},         // stretches
      {{1, 0.7, 0}, {0, 1, -0.2}, {0.1, 0, 1}},    // shears
      {{1, 0, 0}, {0, 1, 0}, {0, 0, -1}},          // mirrors
      {{-2, 0, 0}, {0, -2, 0}, {0, 0, -2}},        // mirrors and scales
      {{0.3, 0.7, 2}, {1, -1, -0.2}, {0.1, 0, 1}}, // all of it
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 0}},           // flattens to a plane
      {{1, 2, 3}, {2, 4, 6}, {0, 0, 0}},           // and to a line
      {{0, 0, 0}, {0, 1e-3, 0}, {0, 0, 0}},
  };
  const Scene S = randomScene(20, 1, 3);
  for (const auto &M : Matrices) {
    const Scene Read = parsed(glbOf(gltfOf(S, "", matrixOf(M).dump())));
    ASSERT_EQ(Read.size(), S.size());
    for (std::size_t I = 0; I < S.size(); ++I) {
      double Largest = 0;
      for (std::size_t R = 0; R < 3; ++R) {
        double Moved = 0;
        for (std::size_t C = 0; C < 3; ++C)
          Moved += M[R][C] * S.Means[3 * I + C];
        EXPECT_NEAR(Read.Means[3 * I + R], Moved, 3e-5);
        Largest = std::max(Largest, covariance(Read, I, R, R));
      }
      for (std::size_t R = 0; R < 3; ++R)
        for (std::size_t C = 0; C < 3; ++C) {
          double Sum = 0;
          for (std::size_t A = 0; A < 3; ++A)
            for (std::size_t B = 0; B < 3; ++B)
              Sum += M[R][A] * covariance(S, I, A, B) * M[C][B];
          EXPECT_NEAR(covariance(Read, I, R, C), Sum, 2e-6 * Largest);
        }
    }
  }
}

TEST(Gltf, MirroredNodesMirrorTheHarmonics) {
  const Scene S = randomScene(20, 3, 3);
  Scene Mirrored = S;
  changeAxes(Mirrored, {.From = {1, 1, 1}, .To = {-1, 1, 1}});
  expectSame(parsed(glbOf(gltfOf(S, "", R"({"scale": [-1, 1, 1]})"))),
             Mirrored);
  // Of the quaternions of an ellipsoid this may be another.
  Mirrored = S;
  changeAxes(Mirrored, {.From = {1, 1, 1}, .To = {1, -1, 1}});
  const Scene Read = parsed(glbOf(gltfOf(S, "", R"({"scale": [1, -1, 1]})")));
  const auto D = differencesOf(Read, Mirrored);
  EXPECT_LE(D.Position, 1e-5);
  EXPECT_LE(D.LogScale, 2e-6);
  EXPECT_LE(D.Harmonics, 2e-6);
  // A rotation alone is one, however it is written.
  Scene Turned = S;
  transform(Turned, {1, rotationOf({0, 0, 180}), {}});
  expectSame(parsed(glbOf(gltfOf(S, "", R"({"scale": [-1, -1, 1]})"))), Turned);
}

TEST(Gltf, AScaleOfZeroHides) {
  const Scene S = randomScene(5, 1, 3);
  const std::string Both = changed(gltfOf(S), [](Json &J) {
    J["nodes"].push_back({{"mesh", 0}, {"scale", {0, 0, 0}}});
    J["scenes"][0]["nodes"] = {0, 1};
  });
  const auto Read = parseScene("s", std::as_bytes(std::span(Both)));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Gaussians.size(), 5U);
  ASSERT_EQ(Read->Skipped.size(), 1U);
  EXPECT_EQ(Read->Skipped[0], "1 meshes that a scale of 0 hides");
}

TEST(Gltf, PrimitivesAreJoinedAndMeshesAreCounted) {
  const Scene S = randomScene(5, 1, 3);
  const std::string File = changed(gltfOf(S), [](Json &J) {
    const Json Second = J["meshes"][0]["primitives"][0];
    Json Third = Second;
    Third.erase("extensions");
    J["meshes"][0]["primitives"].push_back(Second);
    J["meshes"][0]["primitives"].push_back(Third);
  });
  const auto Read = parseScene("s", std::as_bytes(std::span(File)));
  ASSERT_TRUE(Read) << Read.error().What;
  EXPECT_EQ(Read->Gaussians.size(), 10U);
  EXPECT_TRUE(Read->Skipped.empty());
  EXPECT_EQ(Read->Meshes, 1U);
}

TEST(Gltf, SpzMayBeInside) {
  const Scene S = randomScene(9, 2, 3);
  const std::string Spz = gzipOf(spzBodyOf(S, 2));
  const Scene Alone = parsedAs(SceneFormat::Spz, Spz).Gaussians;
  const Scene Inside = parsed(glbOf(gltfOfSpz(Spz)));
  EXPECT_EQ(Inside.Means, Alone.Means);
  EXPECT_EQ(Inside.Quats, Alone.Quats);
  EXPECT_EQ(Inside.Sh, Alone.Sh);
}

TEST(Gltf, SmallIntegersAreNormalised) {
  const GltfParts P = gltfOf(randomScene(1, 0, 3));
  // Rotation in signed bytes, scale in shorts as they are, opacity in a byte.
  const std::string Extra("\x7f\x00\x81\x80\x02\x00\x00\x01\x01\x00\x33\x00",
                          12);
  Json J = Json::parse(P.Text);
  const auto From = P.Buffer.size();
  const auto Set = [&](std::size_t Index, int Component, std::size_t Offset,
                       std::size_t Length, bool Normalised) {
    J["accessors"][Index]["componentType"] = Component;
    J["accessors"][Index]["normalized"] = Normalised;
    J["bufferViews"][Index]["byteOffset"] = From + Offset;
    J["bufferViews"][Index]["byteLength"] = Length;
  };
  Set(1, 5120, 0, 4, true);
  Set(2, 5123, 4, 6, false);
  Set(3, 5121, 10, 1, true);
  J["buffers"][0]["byteLength"] = From + 12;
  const Scene S = parsed(glbOf({J.dump(), P.Buffer + Extra}));
  // w is -128 / 127, which is cut to -1.
  EXPECT_EQ(S.Quats, (std::vector<float>{-1, 1, 0, -1}));
  EXPECT_NEAR(S.LogScales[0], std::log(2), 1e-6);
  EXPECT_NEAR(S.LogScales[1], std::log(256), 1e-6);
  EXPECT_NEAR(1 / (1 + std::exp(-S.OpacityLogits[0])), 0.2, 1e-6);
}

TEST(Gltf, EveryTruncationIsAnError) {
  const std::string File = glbOf(gltfOf(randomScene(5, 1, 3)));
  for (std::size_t Size = 0; Size < File.size(); ++Size)
    EXPECT_FALSE(parseScene("s", std::as_bytes(std::span(File.data(), Size)))
                     .operator bool())
        << Size;
}

TEST(Gltf, EachKindOfDamageHasItsMessage) {
  const auto Attributes = [](Json &J) -> Json & {
    return J["meshes"][0]["primitives"][0]["attributes"];
  };
  const auto Extension = [](Json &J) -> Json & {
    return J["meshes"][0]["primitives"][0]["extensions"]
            ["KHR_gaussian_splatting"];
  };
  const struct {
    std::function<void(Json &)> Change;
    const char *Message;
  } Cases[] = {
      {[](Json &J) { J["asset"]["version"] = "1.0"; }, "glTF 1.0, expected"},
      {[](Json &J) { J["extensionsRequired"] = {"EXT_new"}; },
       "requires \"EXT_new\""},
      {[&](Json &J) { Extension(J)["kernel"] = "box"; },
       "mesh 0 primitive 0: kernel \"box\" is not supported"},
      {[&](Json &J) { Extension(J)["colorSpace"] = "lin_rec709_display"; },
       "colorSpace \"lin_rec709_display\""},
      {[&](Json &J) { Extension(J)["quantizedPositionScale"] = 0.5; },
       "quantizedPositionScale is unknown"},
      {[&](Json &J) { Extension(J)["extensions"]["EXT_packed"] = {{"a", 1}}; },
       "extension EXT_packed is not supported"},
      {[](Json &J) { J["bufferViews"][0]["extensions"]["EXT_meshopt"] = 1; },
       "bufferView 0 is packed by EXT_meshopt"},
      {[](Json &J) { J["accessors"][0]["sparse"] = Json::object(); },
       "accessor 0 is sparse"},
      {[](Json &J) { J["accessors"][0].erase("bufferView"); },
       "accessor 0 has no bufferView"},
      {[](Json &J) { J["accessors"][0]["count"] = 1e15; },
       "accessor 0 exceeds its bufferView"},
      {[](Json &J) { J["accessors"][0]["count"] = -1; }, "an invalid count"},
      {[](Json &J) { J["accessors"][0]["byteOffset"] = 9e15; },
       "accessor 0 exceeds"},
      {[](Json &J) { J["accessors"][0]["type"] = "MAT4"; }, "unknown type"},
      {[](Json &J) { J["accessors"][0]["type"] = "VEC4"; },
       "exceeds its bufferView"},
      {[](Json &J) { J["accessors"][0]["count"] = 4; },
       "attributes have 4 and 5 elements"},
      {[](Json &J) { J["bufferViews"][0]["byteLength"] = 9e15; },
       "bufferView 0 is not in a buffer"},
      {[](Json &J) { J["bufferViews"][0]["byteStride"] = 4; },
       "exceeds its bufferView"},
      {[](Json &J) { J["buffers"][0]["byteLength"] = 1e9; },
       "expected 1000000000 as its byteLength says"},
      {[](Json &J) { J["buffers"][0]["uri"] = "data:x;base64,**"; },
       "data that are not base64"},
      {[&](Json &J) { Attributes(J).erase("POSITION"); },
       "attribute POSITION is missing"},
      {[&](Json &J) {
         Attributes(J).erase("KHR_gaussian_splatting:SH_DEGREE_1_COEF_1");
       },
       "harmonics of degree 1 are incomplete"},
      {[&](Json &J) { Attributes(J)["POSITION"] = 99; },
       "no object 99 in accessors"},
      {[](Json &J) {
         J["nodes"][0]["scale"] = {1e200, 1, 1};
         J["nodes"].push_back({{"children", {0}}, {"scale", {1e200, 1, 1}}});
         J["scenes"][0]["nodes"] = {1};
       },
       "the product of its nodes' transforms is not finite"},
      {[](Json &J) { J["nodes"][0]["scale"] = {1, 1}; },
       "an invalid transform"},
      {[](Json &J) { J["nodes"][0]["children"] = {0}; },
       "has two parents or is part of a cycle"},
      {[](Json &J) { J["nodes"][0]["mesh"] = 7; }, "no object 7 in meshes"},
      {[](Json &J) { J.erase("nodes"); }, "no nodes"},
      {[](Json &J) { J["meshes"][0]["primitives"][0].erase("extensions"); },
       "no primitive with KHR_gaussian_splatting"},
      {[](Json &J) {
         Json One = J["meshes"][0]["primitives"][0];
         for (int I = 0; I < 500; ++I)
           J["meshes"][0]["primitives"].push_back(One);
       },
       "more Gaussians than its buffers can contain"},
  };
  const GltfParts P = gltfOf(randomScene(5, 1, 3));
  for (const auto &[Change, Message] : Cases) {
    const std::string File = changed(P, Change);
    const auto Read = parseScene("s", std::as_bytes(std::span(File)));
    ASSERT_FALSE(Read) << Message;
    EXPECT_NE(Read.error().What.find(Message), std::string::npos)
        << Read.error().What << "\nexpected " << Message;
  }
}

} // namespace
