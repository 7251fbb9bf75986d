#include "scene/formats/GltfWriter.h"

#include "scene/Activation.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

namespace vorion::splat {

static constexpr int UnsignedInt = 5125, Float = 5126;

GltfWriter::GltfWriter()
    : Document{{"asset", {{"version", "2.0"}, {"generator", "splat"}}},
               {"scene", 0},
               {"scenes", {{{"nodes", Json::array()}}}}} {}

std::size_t GltfWriter::add(const char *Key, Json Object) {
  Json &List = Document[Key];
  List.push_back(std::move(Object));
  return List.size() - 1;
}

void GltfWriter::useExtension(std::string_view Name, bool IsRequired) {
  for (const char *Key : {"extensionsUsed", "extensionsRequired"}) {
    if (!IsRequired && Key == std::string_view("extensionsRequired"))
      continue;
    Json &List = Document[Key];
    if (std::ranges::find(List, Json(Name)) == List.end())
      List.push_back(Name);
  }
}

std::size_t GltfWriter::addView(std::span<const std::byte> Content) {
  const std::size_t Offset = Buffer.size();
  Buffer.append(reinterpret_cast<const char *>(Content.data()), Content.size());
  Buffer.resize((Buffer.size() + 3) / 4 * 4);
  return add(
      "bufferViews",
      {{"buffer", 0}, {"byteOffset", Offset}, {"byteLength", Content.size()}});
}

std::size_t GltfWriter::addNumbers(std::span<const std::byte> Content,
                                   int Component, const char *Type,
                                   std::size_t Count) {
  return add("accessors", {{"bufferView", addView(Content)},
                           {"componentType", Component},
                           {"count", Count},
                           {"type", Type}});
}

std::size_t GltfWriter::addAccessor(std::span<const float> Numbers,
                                    std::size_t Width, bool HasBounds) {
  constexpr const char *Types[] = {"", "SCALAR", "VEC2", "VEC3", "VEC4"};
  const std::size_t Index = addNumbers(std::as_bytes(Numbers), Float,
                                       Types[Width], Numbers.size() / Width);
  if (!HasBounds || Numbers.empty())
    return Index;
  const auto First = Numbers.first(Width);
  std::vector<float> Least(First.begin(), First.end()), Largest = Least;
  for (std::size_t I = 0; I < Numbers.size(); ++I) {
    Least[I % Width] = std::min(Least[I % Width], Numbers[I]);
    Largest[I % Width] = std::max(Largest[I % Width], Numbers[I]);
  }
  Document["accessors"][Index]["min"] = Least;
  Document["accessors"][Index]["max"] = Largest;
  return Index;
}

std::size_t GltfWriter::addIndices(std::span<const uint32_t> Numbers) {
  return addNumbers(std::as_bytes(Numbers), UnsignedInt, "SCALAR",
                    Numbers.size());
}

void GltfWriter::addNode(Json Primitives, const std::string &Name) {
  const std::size_t Mesh =
      add("meshes", {{"primitives", std::move(Primitives)}});
  Json Node{{"mesh", Mesh}};
  if (!Name.empty())
    Node["name"] = Name;
  Document["scenes"][0]["nodes"].push_back(add("nodes", std::move(Node)));
}

void GltfWriter::addGaussians(const Scene &S) {
  const Activated<double> A = activate<double>(S);
  Json Attributes;
  std::vector<float> Numbers;
  const auto Add = [&](const std::string &Name, std::size_t Width,
                       const auto &Value) {
    Numbers.clear();
    for (std::size_t I = 0; I < S.size(); ++I)
      for (std::size_t K = 0; K < Width; ++K)
        Numbers.push_back(static_cast<float>(Value(I, K)));
    Attributes[Name] = addAccessor(Numbers, Width, Name == "POSITION");
  };
  constexpr std::string_view Extension = "KHR_gaussian_splatting";
  Add("POSITION", 3,
      [&](std::size_t I, std::size_t K) { return S.mean(3 * I + K); });
  Add(fmt::format("{}:ROTATION", Extension), 4,
      [&](std::size_t I, std::size_t K) {
        // A quaternion of zeros is no rotation.
        const double *Q = &A.Quats[4 * I];
        const bool IsZero =
            std::all_of(Q, Q + 4, [](double V) { return V == 0; });
        return IsZero ? double(K == 3) : Q[(K + 1) % 4];
      });
  Add(fmt::format("{}:SCALE", Extension), 3,
      [&](std::size_t I, std::size_t K) { return A.Scales[3 * I + K]; });
  Add(fmt::format("{}:OPACITY", Extension), 1,
      [&](std::size_t I, std::size_t /*K*/) { return A.Opacities[I]; });
  std::size_t Term = 0;
  for (int Band = 0; Band <= S.ShDegree; ++Band)
    for (int M = 0; M < 2 * Band + 1; ++M, ++Term)
      Add(fmt::format("{}:SH_DEGREE_{}_COEF_{}", Extension, Band, M), 3,
          [&](std::size_t I, std::size_t K) {
            return S.Sh[3 * (S.coefficients() * I + Term) + K];
          });
  useExtension(Extension);
  addNode({{{"mode", 0},
            {"attributes", std::move(Attributes)},
            {"extensions",
             {{Extension,
               {{"kernel", "ellipse"},
                {"colorSpace", "srgb_rec709_display"},
                {"projection", "perspective"},
                {"sortingMethod", "cameraDistance"}}}}}}});
}

Expected<std::string> GltfWriter::finish() const {
  Json Whole = Document;
  Whole["buffers"] = {{{"byteLength", Buffer.size()}}};
  std::string Text = jsonText(Whole);
  Text.resize((Text.size() + 3) / 4 * 4, ' ');
  const std::size_t Size = 12 + 8 + Text.size() + 8 + Buffer.size();
  if (Size > std::numeric_limits<uint32_t>::max())
    return Error{"", fmt::format("{} bytes, expected at most 4 GiB, the limit "
                                 "of .glb",
                                 Size)};
  std::string File;
  File.reserve(Size);
  const auto Put = [&](std::size_t Word) {
    for (int Byte = 0; Byte < 4; ++Byte)
      File += static_cast<char>(Word >> 8 * Byte & 0xFF);
  };
  File += "glTF";
  Put(2);
  Put(Size);
  Put(Text.size());
  File += "JSON" + Text;
  Put(Buffer.size());
  File += std::string("BIN\0", 4) + Buffer;
  return File;
}

} // namespace vorion::splat
