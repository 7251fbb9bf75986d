// A mesh as a node of a `.glb`.
#include "mesh/Mesh.h"
#include "scene/formats/GltfWriter.h"
#include "vorion/support/FileKind.h"

#include <bit>
#include <map>

namespace vorion::splat {
namespace {

using Json = GltfWriter::Json;

/// The vertices and triangles of one material.
class Part {
public:
  explicit Part(const Mesh &M) : M(M) {}

  void addCorner(std::size_t Corner) {
    // A vertex, its texture coordinates and its normal, bit by bit.
    std::array<uint32_t, 6> Key{M.Corners[Corner]};
    if (M.hasTextures())
      for (std::size_t K = 0; K < 2; ++K)
        Key[1 + K] =
            std::bit_cast<uint32_t>(M.TextureCoordinates[2 * Corner + K]);
    if (!M.Normals.empty())
      for (std::size_t K = 0; K < 3; ++K)
        Key[3 + K] = std::bit_cast<uint32_t>(M.Normals[3 * Corner + K]);
    const auto [It, IsNew] =
        Known.try_emplace(Key, static_cast<uint32_t>(Known.size()));
    Indices.push_back(It->second);
    if (!IsNew)
      return;
    const std::size_t V = M.Corners[Corner];
    for (std::size_t K = 0; K < 3; ++K)
      Positions.push_back(M.Positions[3 * V + K]);
    for (std::size_t K = 0; K < 4; ++K)
      Colors.push_back(K < 3 ? static_cast<float>(toLinear(M.Colors[4 * V + K]))
                             : M.Colors[4 * V + K]);
    for (std::size_t K = 0; K < 2; ++K)
      Coordinates.push_back(std::bit_cast<float>(Key[1 + K]));
    for (std::size_t K = 0; K < 3; ++K)
      Normals.push_back(std::bit_cast<float>(Key[3 + K]));
  }

  Json primitive(GltfWriter &To) const {
    Json Attributes{{"POSITION", To.addAccessor(Positions, 3, true)},
                    {"COLOR_0", To.addAccessor(Colors, 4)}};
    if (M.hasTextures())
      Attributes["TEXCOORD_0"] = To.addAccessor(Coordinates, 2);
    if (!M.Normals.empty())
      Attributes["NORMAL"] = To.addAccessor(Normals, 3);
    return {{"attributes", std::move(Attributes)},
            {"indices", To.addIndices(Indices)}};
  }

private:
  const Mesh &M;
  std::map<std::array<uint32_t, 6>, uint32_t> Known;
  std::vector<float> Positions, Colors, Coordinates, Normals;
  std::vector<uint32_t> Indices;
};

/// The materials of a mesh, each added when it is first used.
class Looks {
public:
  Looks(GltfWriter &To, const Mesh &M) : To(To), M(M) {}

  std::size_t material(uint32_t Look) {
    const auto [It, IsNew] = Materials.try_emplace(Look, 0);
    if (IsNew)
      It->second = addMaterial(M.Materials[Look]);
    return It->second;
  }

private:
  std::size_t addMaterial(const Material &From) {
    // Colours are those of the vertices, without light.
    To.useExtension("KHR_materials_unlit");
    Json J{{"doubleSided", true},
           {"extensions", {{"KHR_materials_unlit", Json::object()}}}};
    if (From.Picture)
      J["pbrMetallicRoughness"] = {
          {"baseColorTexture", {{"index", addTexture(From)}}}};
    if (From.Alpha != AlphaMode::Opaque)
      J["alphaMode"] = From.Alpha == AlphaMode::Mask ? "MASK" : "BLEND";
    if (From.Alpha == AlphaMode::Mask)
      J["alphaCutoff"] = From.Cutoff;
    return To.add("materials", std::move(J));
  }

  std::size_t addTexture(const Material &From) {
    const std::vector<std::byte> &File = M.Textures[*From.Picture].File;
    const FileKind Kind = fileKindOf(File);
    const char *Type = Kind == FileKind::Png    ? "image/png"
                       : Kind == FileKind::Jpeg ? "image/jpeg"
                                                : "image/webp";
    const auto [It, IsNew] = Images.try_emplace(*From.Picture, 0);
    if (IsNew)
      It->second = To.add(
          "images", {{"bufferView", To.addView(File)}, {"mimeType", Type}});
    Json J{{"sampler", addSampler(From.Sampling)}};
    if (Kind == FileKind::WebP) {
      To.useExtension("EXT_texture_webp", /*IsRequired=*/true);
      J["extensions"] = {{"EXT_texture_webp", {{"source", It->second}}}};
    } else {
      J["source"] = It->second;
    }
    return To.add("textures", std::move(J));
  }

  std::size_t addSampler(const Sampler &S) {
    constexpr int Nearest = 9728, FirstWithMips = 9984;
    const int Linear = S.MinifiesLinearly ? 1 : 0;
    const auto Mode = [](Wrap W) {
      return W == Wrap::Repeat ? 10497 : W == Wrap::Mirror ? 33648 : 33071;
    };
    return To.add(
        "samplers",
        {{"magFilter", Nearest + (S.MagnifiesLinearly ? 1 : 0)},
         {"minFilter", S.Levels == Sampler::Mips::None ? Nearest + Linear
                       : S.Levels == Sampler::Mips::Nearest
                           ? FirstWithMips + Linear
                           : FirstWithMips + 2 + Linear},
         {"wrapS", Mode(S.Wraps[0])},
         {"wrapT", Mode(S.Wraps[1])}});
  }

  GltfWriter &To;
  const Mesh &M;
  std::map<uint32_t, std::size_t> Materials; ///< of the mesh, in the file
  std::map<uint32_t, std::size_t> Images;    ///< of textures
};

} // namespace

void addMesh(GltfWriter &To, const Mesh &M) {
  Looks Of(To, M);
  std::size_t T = 0;
  for (std::size_t N = 0; N < M.Parts.size(); ++N) {
    const std::size_t End =
        N + 1 < M.Parts.size() ? M.Parts[N + 1].First : M.triangles();
    // Runs of triangles with one material: their order decides between equals.
    Json Primitives = Json::array();
    while (T < End) {
      const uint32_t Look = M.MaterialOf[T];
      Part P(M);
      for (; T < End && M.MaterialOf[T] == Look; ++T)
        for (std::size_t K = 0; K < 3; ++K)
          P.addCorner(3 * T + K);
      Json Primitive = P.primitive(To);
      Primitive["material"] = Of.material(Look);
      Primitives.push_back(std::move(Primitive));
    }
    To.addNode(std::move(Primitives), M.Parts[N].Name);
  }
}

} // namespace vorion::splat
