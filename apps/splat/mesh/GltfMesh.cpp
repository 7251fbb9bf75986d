// glTF 2.0: the triangles of all nodes of the default scene, with base colours,
// vertex colours and textures. Colours are linear there, and pictures are not:
// each vertex's colour is encoded as sRGB is.
#include "mesh/Mesh.h"
#include "scene/formats/Gltf.h"
#include "scene/formats/GltfData.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <optional>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

/// Extensions that change neither triangles nor unlit colours.
bool isHarmless(const std::string &Name) {
  constexpr std::array<std::string_view, 6> Starts{
      "KHR_materials_", "KHR_texture_",          "EXT_texture_",
      "KHR_lights_",    "KHR_mesh_quantization", "KHR_gaussian_splatting"};
  return std::ranges::any_of(
      Starts, [&](std::string_view S) { return Name.starts_with(S); });
}

const Json *memberOf(const Json &Object, const char *Key) {
  const auto It = Object.is_object() ? Object.find(Key) : Object.end();
  return Object.is_object() && It != Object.end() ? &*It : nullptr;
}

/// How texture coordinates become those of the picture
/// (KHR_texture_transform).
struct TextureTransform {
  std::array<double, 2> Offset{}, Scale{1, 1};
  double Rotation = 0;

  std::array<float, 2> of(double U, double V) const {
    const double C = std::cos(Rotation), S = std::sin(Rotation);
    U *= Scale[0];
    V *= Scale[1];
    return {static_cast<float>(C * U + S * V + Offset[0]),
            static_cast<float>(C * V - S * U + Offset[1])};
  }
};

/// A material of the file.
struct GltfMaterial {
  uint32_t Look = 0; ///< of the mesh
  std::array<double, 4> Base{1, 1, 1, 1};
  std::string Coordinates; ///< the attribute with those of the texture
  TextureTransform Transform;
};

/// A normal that the upper part of \p To transforms: by its cofactors, which
/// are its inverse's transpose up to a factor. 0 if it is not finite.
std::array<float, 3> turned(const GltfMatrix &To,
                            const std::array<double, 3> &N) {
  std::array<float, 3> Result{};
  for (std::size_t R = 0; R < 3; ++R) {
    const std::size_t R1 = (R + 1) % 3, R2 = (R + 2) % 3;
    double Sum = 0;
    for (std::size_t C = 0; C < 3; ++C) {
      const std::size_t C1 = (C + 1) % 3, C2 = (C + 2) % 3;
      Sum += (To[4 * C1 + R1] * To[4 * C2 + R2] -
              To[4 * C2 + R1] * To[4 * C1 + R2]) *
             N[C];
    }
    Result[R] = static_cast<float>(Sum);
    if (!std::isfinite(Result[R]))
      return {};
  }
  return Result;
}

class Reader {
public:
  Reader(const std::string &Where, const GltfData &Data)
      : Where(Where), Data(Data), Files(filesBeside(Where)) {
    Result.Materials.emplace_back(); // of primitives without one
  }

  Expected<Mesh> read();

private:
  Error wrong(const std::string &What) const {
    return {Where, Name.empty() ? What : Name + ": " + What};
  }
  Expected<Success> primitive(const Json &J, const GltfMatrix &To);
  Expected<GltfMaterial> materialOf(const Json &J);
  Expected<GltfMaterial> readMaterial(std::size_t Number);
  Expected<Success> readTexture(const Json &Use, GltfMaterial &M);
  Expected<uint32_t> pictureOf(const Json &Texture);
  Expected<Sampler> samplerOf(const Json &Texture) const;
  Expected<std::optional<GltfAccessor>> attribute(const Json &J,
                                                  const char *Key) const;
  Expected<std::vector<uint32_t>> corners(const Json &J,
                                          std::size_t Vertices) const;

  const std::string &Where;
  const GltfData &Data;
  GltfSource Files; ///< of pictures
  std::string Name; ///< of the primitive that is read
  Mesh Result;
  std::map<std::size_t, GltfMaterial> Materials; ///< that were read
  std::map<std::size_t, uint32_t> Pictures;      ///< images, in the mesh
};

/// The material of a primitive.
Expected<GltfMaterial> Reader::materialOf(const Json &J) {
  if (!J.contains("material"))
    return GltfMaterial{};
  const auto Number = gltfIndex(J, "material", std::nullopt);
  if (!Number)
    return wrong("material is not a number, expected an index");
  if (const auto Known = Materials.find(*Number); Known != Materials.end())
    return Known->second;
  auto M = readMaterial(*Number);
  if (M)
    Materials[*Number] = *M;
  return M;
}

Expected<GltfMaterial> Reader::readMaterial(std::size_t Number) {
  const auto J = Data.objectAt("materials", Number);
  if (!J)
    return J.error();
  GltfMaterial M;
  M.Look = static_cast<uint32_t>(Result.Materials.size());
  Material &Look = Result.Materials.emplace_back();
  if (const Json *Mode = memberOf(**J, "alphaMode")) {
    if (*Mode == "MASK")
      Look.Alpha = AlphaMode::Mask;
    else if (*Mode == "BLEND")
      Look.Alpha = AlphaMode::Blend;
    else if (*Mode != "OPAQUE")
      return wrong(fmt::format("material {} has alphaMode {}, expected "
                               "\"OPAQUE\", \"MASK\" or \"BLEND\"",
                               Number, printable(jsonText(*Mode))));
  }
  if (const Json *Cutoff = memberOf(**J, "alphaCutoff")) {
    if (!Cutoff->is_number() || !(Cutoff->get<double>() >= 0))
      return wrong(fmt::format("material {} has alphaCutoff {}, expected a "
                               "number of 0 or more",
                               Number, printable(jsonText(*Cutoff))));
    Look.Cutoff = static_cast<float>(Cutoff->get<double>());
  }
  const Json *Pbr = memberOf(**J, "pbrMetallicRoughness");
  if (!Pbr)
    return M;
  if (const Json *Factor = memberOf(*Pbr, "baseColorFactor"))
    for (std::size_t C = 0; C < 4; ++C) {
      const bool Is =
          Factor->is_array() && Factor->size() == 4 && (*Factor)[C].is_number();
      M.Base[C] = Is ? (*Factor)[C].get<double>() : -1;
      if (!(M.Base[C] >= 0 && M.Base[C] <= 1))
        return wrong(fmt::format("material {} has baseColorFactor {}, expected "
                                 "four numbers from 0 to 1",
                                 Number, printable(jsonText(*Factor))));
    }
  if (const Json *Use = memberOf(*Pbr, "baseColorTexture"))
    if (auto Done = readTexture(*Use, M); !Done)
      return Error{Done.error().Where,
                   fmt::format("material {}: {}", Number, Done.error().What),
                   Done.error().Code};
  return M;
}

/// Reads what a material's baseColorTexture \p Use names.
Expected<Success> Reader::readTexture(const Json &Use, GltfMaterial &M) {
  const auto Bad = [&](std::string What) {
    return Error{Where, std::move(What)};
  };
  const auto Number = gltfIndex(Use, "index", std::nullopt);
  auto Set = gltfIndex(Use, "texCoord", 0);
  const Json *Own = memberOf(Use, "extensions");
  const Json *Moved = Own ? memberOf(*Own, "KHR_texture_transform") : nullptr;
  if (Moved) {
    Set = gltfIndex(*Moved, "texCoord", Set);
    const auto Get = [&](const char *Key, double *To, std::size_t N) {
      const Json *Value = memberOf(*Moved, Key);
      for (std::size_t I = 0; Value && I < N; ++I) {
        const Json &One = N == 1 ? *Value : (*Value)[I];
        if (!One.is_number())
          return false;
        To[I] = One.get<double>();
      }
      return true;
    };
    for (const char *Key : {"offset", "scale"})
      if (const Json *Value = memberOf(*Moved, Key);
          Value && (!Value->is_array() || Value->size() != 2))
        return Bad(fmt::format("KHR_texture_transform has {} {}, expected two "
                               "numbers",
                               Key, printable(jsonText(*Value))));
    if (!Get("offset", M.Transform.Offset.data(), 2) ||
        !Get("scale", M.Transform.Scale.data(), 2) ||
        !Get("rotation", &M.Transform.Rotation, 1))
      return Bad("KHR_texture_transform has a value that is not a number, "
                 "expected numbers");
  }
  if (!Number || !Set)
    return Bad("baseColorTexture has no index, expected one of textures");
  const auto Texture = Data.objectAt("textures", *Number);
  if (!Texture)
    return Texture.error();
  const auto Picture = pictureOf(**Texture);
  if (!Picture)
    return Picture.error();
  const auto Sampling = samplerOf(**Texture);
  if (!Sampling)
    return Sampling.error();
  Result.Materials[M.Look].Picture = *Picture;
  Result.Materials[M.Look].Sampling = *Sampling;
  M.Coordinates = fmt::format("TEXCOORD_{}", *Set);
  return Success{};
}

/// The picture of a texture, in the mesh.
Expected<uint32_t> Reader::pictureOf(const Json &Texture) {
  auto Image = gltfIndex(Texture, "source", std::nullopt);
  const Json *Own = memberOf(Texture, "extensions");
  if (const Json *WebP = Own ? memberOf(*Own, "EXT_texture_webp") : nullptr)
    Image = gltfIndex(*WebP, "source", std::nullopt);
  if (!Image)
    return Error{Where,
                 fmt::format("its texture has no source{}, expected a PNG, "
                             "JPEG or WebP",
                             Own && !Own->empty()
                                 ? fmt::format(" without {}",
                                               printable(Own->begin().key()))
                                 : "")};
  const auto [Known, IsNew] = Pictures.try_emplace(
      *Image, static_cast<uint32_t>(Result.Textures.size()));
  if (IsNew) {
    const auto File = Data.image(*Image, Files);
    if (!File)
      return File.error();
    auto Decoded =
        decodeTexture(fmt::format("{}: image {}", Where, *Image), *File);
    if (!Decoded)
      return Decoded.error();
    Result.Textures.push_back(std::move(*Decoded));
  }
  return Known->second;
}

/// How a texture is sampled: without a sampler linearly, with all levels.
Expected<Sampler> Reader::samplerOf(const Json &Texture) const {
  Sampler S;
  if (!Texture.contains("sampler"))
    return S;
  const auto Number = gltfIndex(Texture, "sampler", std::nullopt);
  if (!Number)
    return Error{Where, "its sampler is not a number, expected an index"};
  const auto J = Data.objectAt("samplers", *Number);
  if (!J)
    return J.error();
  const auto Value = [&](const char *Key, std::size_t Otherwise) {
    return gltfIndex(**J, Key, Otherwise).value_or(0);
  };
  // OpenGL's numbers.
  constexpr std::size_t Nearest = 9728, Linear = 9729, FirstWithMips = 9984,
                        Clamp = 33071, Mirror = 33648, Repeat = 10497;
  const std::size_t Larger = Value("magFilter", Linear),
                    Smaller = Value("minFilter", FirstWithMips + 3);
  bool IsKnown = Larger == Nearest || Larger == Linear;
  S.MagnifiesLinearly = Larger == Linear;
  if (Smaller == Nearest || Smaller == Linear) {
    S.MinifiesLinearly = Smaller == Linear;
    S.Levels = Sampler::Mips::None;
  } else {
    IsKnown &= Smaller >= FirstWithMips && Smaller < FirstWithMips + 4;
    S.MinifiesLinearly = Smaller % 2 == 1;
    S.Levels = Smaller < FirstWithMips + 2 ? Sampler::Mips::Nearest
                                           : Sampler::Mips::Linear;
  }
  for (std::size_t A = 0; A < 2; ++A) {
    const std::size_t Mode = Value(A == 0 ? "wrapS" : "wrapT", Repeat);
    IsKnown &= Mode == Repeat || Mode == Mirror || Mode == Clamp;
    S.Wraps[A] = Mode == Clamp    ? Wrap::Clamp
                 : Mode == Mirror ? Wrap::Mirror
                                  : Wrap::Repeat;
  }
  if (!IsKnown)
    return Error{Where, fmt::format("sampler {} has a filter or wrap mode that "
                                    "glTF does not have, expected its numbers",
                                    *Number)};
  return S;
}

Expected<std::optional<GltfAccessor>> Reader::attribute(const Json &J,
                                                        const char *Key) const {
  const Json *All = memberOf(J, "attributes");
  if (!All || !memberOf(*All, Key))
    return std::optional<GltfAccessor>();
  const auto Number = gltfIndex(*All, Key, std::nullopt);
  if (!Number)
    return wrong(fmt::format("attribute {} is not a number, expected the index "
                             "of an accessor",
                             Key));
  auto A = Data.accessor(*Number);
  if (!A)
    return A.error();
  return std::optional(*A);
}

/// The vertices of the triangles, three each.
Expected<std::vector<uint32_t>> Reader::corners(const Json &J,
                                                std::size_t Vertices) const {
  std::vector<uint32_t> Listed;
  if (J.contains("indices")) {
    const auto Number = gltfIndex(J, "indices", std::nullopt);
    if (!Number)
      return wrong(
          "indices is not a number, expected the index of an accessor");
    const auto A = Data.accessor(*Number);
    if (!A)
      return A.error();
    if (A->Width != 1)
      return wrong(fmt::format("indices have {} numbers per element, expected "
                               "1",
                               A->Width));
    for (std::size_t I = 0; I < A->Count; ++I) {
      const double V = A->at(I, 0);
      if (!(V >= 0 && V < static_cast<double>(Vertices)))
        return wrong(fmt::format("index {} is {}, expected one of {} vertices",
                                 I, V, Vertices));
      Listed.push_back(static_cast<uint32_t>(V));
    }
  } else {
    for (std::size_t I = 0; I < Vertices; ++I)
      Listed.push_back(static_cast<uint32_t>(I));
  }
  const auto Mode = gltfIndex(J, "mode", 4);
  if (Mode == 4) {
    if (Listed.size() % 3 != 0)
      return wrong(fmt::format("{} corners of triangles, expected a multiple "
                               "of 3",
                               Listed.size()));
    return Listed;
  }
  if (Mode != 5 && Mode != 6)
    return wrong(fmt::format("mode {} is not supported, expected triangles (4 "
                             "to 6)",
                             Mode ? std::to_string(*Mode) : "?"));
  // A strip's or a fan's triangle is its last two corners and the one before,
  // or the first.
  std::vector<uint32_t> Corners;
  for (std::size_t I = 2; I < Listed.size(); ++I)
    Corners.insert(Corners.end(), {Mode == 5 ? Listed[I - 2] : Listed[0],
                                   Listed[I - 1], Listed[I]});
  return Corners;
}

Expected<Success> Reader::primitive(const Json &J, const GltfMatrix &To) {
  if (const Json *Own = memberOf(J, "extensions"))
    for (const auto &[Key, Value] : Own->items())
      if (!isHarmless(Key))
        return wrong(fmt::format("extension {} is not supported, expected "
                                 "plain triangles",
                                 printable(Key)));
  const auto Position = attribute(J, "POSITION");
  if (!Position)
    return Position.error();
  if (!*Position || (*Position)->Width != 3)
    return wrong("no attribute POSITION of three numbers, expected one");
  const auto Skin = attribute(J, "JOINTS_0");
  if (!Skin)
    return Skin.error();
  if (*Skin)
    return wrong("skins (JOINTS_0) are not supported, expected a rigid mesh");
  const auto Color = attribute(J, "COLOR_0");
  if (!Color)
    return Color.error();
  if (*Color && ((*Color)->Count != (*Position)->Count ||
                 ((*Color)->Width != 3 && (*Color)->Width != 4)))
    return wrong(fmt::format("attribute COLOR_0 has {} elements of {} numbers, "
                             "expected {} of 3 or 4",
                             (*Color)->Count, (*Color)->Width,
                             (*Position)->Count));
  const auto Look = materialOf(J);
  if (!Look)
    return Look.error();
  std::optional<GltfAccessor> Coordinates;
  if (!Look->Coordinates.empty()) {
    const auto Found = attribute(J, Look->Coordinates.c_str());
    if (!Found)
      return Found.error();
    Coordinates = *Found;
    if (!Coordinates || Coordinates->Width != 2 ||
        Coordinates->Count != (*Position)->Count)
      return wrong(
          fmt::format("no attribute {} of two numbers for each vertex, "
                      "expected one, because the material has a "
                      "texture",
                      Look->Coordinates));
  }
  const auto Normal = attribute(J, "NORMAL");
  if (!Normal)
    return Normal.error();
  if (*Normal &&
      ((*Normal)->Width != 3 || (*Normal)->Count != (*Position)->Count))
    return wrong("attribute NORMAL has not three numbers for each vertex, "
                 "expected these");
  const auto Corners = corners(J, (*Position)->Count);
  if (!Corners)
    return Corners.error();
  const bool IsOpaque = Result.Materials[Look->Look].Alpha == AlphaMode::Opaque;
  std::vector<MeshCorner> Vertices((*Position)->Count);
  for (std::size_t I = 0; I < Vertices.size(); ++I) {
    std::array<float, 3> World{};
    std::array<float, 4> Rgba{};
    for (std::size_t A = 0; A < 3; ++A) {
      double Sum = To[12 + A];
      for (std::size_t K = 0; K < 3; ++K)
        Sum += To[4 * K + A] * (*Position)->at(I, K);
      World[A] = static_cast<float>(Sum);
      if (!std::isfinite(World[A]))
        return wrong(fmt::format("vertex {} is at {} in the world, expected "
                                 "finite coordinates",
                                 I, World[A]));
    }
    for (std::size_t C = 0; C < 4; ++C) {
      const double Own = *Color && C < (*Color)->Width ? (*Color)->at(I, C) : 1;
      if (!(Own >= 0 && Own <= 1))
        return wrong(fmt::format("vertex {} has a colour of {}, expected 0 to "
                                 "1",
                                 I, Own));
      const double Value = Look->Base[C] * Own;
      Rgba[C] = static_cast<float>(C < 3      ? fromLinear(Value)
                                   : IsOpaque ? 1
                                              : Value);
    }
    MeshCorner &V = Vertices[I];
    V.Vertex = Result.addVertex(World, Rgba);
    if (Coordinates) {
      V.TextureCoordinate =
          Look->Transform.of(Coordinates->at(I, 0), Coordinates->at(I, 1));
      if (!std::isfinite(V.TextureCoordinate[0]) ||
          !std::isfinite(V.TextureCoordinate[1]))
        return wrong(fmt::format("vertex {} has a texture coordinate that is "
                                 "not finite, expected two numbers",
                                 I));
    }
    if (*Normal)
      V.Normal = turned(
          To, {(*Normal)->at(I, 0), (*Normal)->at(I, 1), (*Normal)->at(I, 2)});
  }
  for (std::size_t I = 0; I + 2 < Corners->size(); I += 3)
    Result.addPolygon(std::array{Vertices[(*Corners)[I]],
                                 Vertices[(*Corners)[I + 1]],
                                 Vertices[(*Corners)[I + 2]]},
                      Look->Look);
  return Success{};
}

Expected<Mesh> Reader::read() {
  if (const Json *Needed = memberOf(Data.document(), "extensionsRequired"))
    for (const Json &One : *Needed)
      if (!One.is_string() || !isHarmless(One.get<std::string>()))
        return wrong(fmt::format("requires {}, which is not supported, "
                                 "expected plain triangles",
                                 printable(jsonText(One))));
  const auto Instances = Data.instances();
  if (!Instances)
    return Instances.error();
  // Many nodes may name the same mesh, but a small file not any number.
  constexpr std::size_t Small = std::size_t{1} << 24;
  std::size_t Left = std::max(Data.bytes(), Small);
  for (const GltfInstance &Each : *Instances) {
    const auto Of = Data.objectAt("meshes", Each.Mesh);
    if (!Of)
      return Of.error();
    const Json *Primitives = memberOf(**Of, "primitives");
    if (!Primitives || !Primitives->is_array())
      return Error{Where, fmt::format("mesh {} has no primitives, expected a "
                                      "list",
                                      Each.Mesh)};
    Result.beginPart(Each.Name.empty() ? fmt::format("mesh {}", Each.Mesh)
                                       : Each.Name);
    for (std::size_t P = 0; P < Primitives->size(); ++P) {
      const Json &One = (*Primitives)[P];
      Name = fmt::format("mesh {} primitive {}", Each.Mesh, P);
      if (const Json *Own = memberOf(One, "extensions");
          Own && Own->contains("KHR_gaussian_splatting"))
        continue;
      const std::size_t Before = Result.vertices();
      if (auto Read = primitive(One, Each.Transform); !Read)
        return Read.error();
      const std::size_t More = Result.vertices() - Before;
      if (More > Left)
        return wrong(fmt::format("more than {} vertices with those of all "
                                 "nodes, expected fewer nodes with this mesh",
                                 std::max(Data.bytes(), Small)));
      Left -= More;
    }
  }
  return std::move(Result);
}

} // namespace

Expected<Mesh> readGltfMesh(const std::string &Where, Bytes File) {
  const auto Data = GltfData::open(Where, File, filesBeside(Where));
  if (!Data)
    return Data.error();
  return Reader(Where, *Data).read();
}

} // namespace vorion::splat
