#include "scene/formats/GltfData.h"

#include "io/Inside.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

constexpr uint32_t Magic = 0x46546C67, JsonChunk = 0x4E4F534A,
                   BinaryChunk = 0x004E4942;
constexpr GltfMatrix Identity{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/// The chunks of a `.glb`.
struct Chunks {
  Bytes Text, Binary;
  bool HasBinary = false;
};

Expected<Chunks> chunksOf(const std::string &Where, Bytes File) {
  Chunks Result;
  if (File.size() < 12 || load<uint32_t>(File, 0) != Magic) {
    Result.Text = File;
    return Result;
  }
  if (load<uint32_t>(File, 4) != 2)
    return Error{Where, fmt::format("GLB version {}, expected 2",
                                    load<uint32_t>(File, 4))};
  if (load<uint32_t>(File, 8) != File.size())
    return Error{Where, fmt::format("{} bytes, expected {} as its header says",
                                    File.size(), load<uint32_t>(File, 8))};
  std::size_t At = 12;
  for (int Number = 0; At < File.size(); ++Number) {
    if (File.size() - At < 8 || File.size() - At - 8 < load<uint32_t>(File, At))
      return Error{
          Where,
          fmt::format("chunk {} exceeds the file, expected a complete GLB",
                      Number)};
    const auto Size = load<uint32_t>(File, At),
               Type = load<uint32_t>(File, At + 4);
    const Bytes Content = File.subspan(At + 8, Size);
    if (Number == 0 && Type != JsonChunk)
      return Error{Where, "the first chunk is not JSON, expected a GLB"};
    if (Number == 0)
      Result.Text = Content;
    else if (Number == 1 && Type == BinaryChunk) {
      Result.Binary = Content;
      Result.HasBinary = true;
    }
    At += 8 + std::size_t{Size};
  }
  return Result;
}

/// Base 64, without blanks; nothing if it is none.
std::optional<std::vector<std::byte>> decodeBase64(std::string_view Text) {
  std::vector<std::byte> Out;
  Out.reserve(Text.size() / 4 * 3);
  while (Text.ends_with('='))
    Text.remove_suffix(1);
  uint32_t Bits = 0;
  int Held = 0;
  for (const char C : Text) {
    const auto Value =
        std::string_view("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklm"
                         "nopqrstuvwxyz0123456789+/")
            .find(C);
    if (Value == std::string_view::npos)
      return std::nullopt;
    Bits = Bits << 6 | static_cast<uint32_t>(Value);
    Held += 6;
    if (Held >= 8) {
      Held -= 8;
      Out.push_back(static_cast<std::byte>(Bits >> Held & 0xFF));
    }
  }
  return Out;
}

/// A file's name, in which bytes may be written as %XX.
std::string decodePercents(const std::string &Text) {
  std::string Out;
  const auto Digit = [](char C) {
    return std::string_view("0123456789abcdef")
        .find(static_cast<char>(C >= 'A' && C <= 'F' ? C - 'A' + 'a' : C));
  };
  for (std::size_t I = 0; I < Text.size(); ++I)
    if (Text[I] == '%' && I + 2 < Text.size() && Digit(Text[I + 1]) < 16 &&
        Digit(Text[I + 2]) < 16) {
      Out += static_cast<char>(16 * Digit(Text[I + 1]) + Digit(Text[I + 2]));
      I += 2;
    } else {
      Out += Text[I];
    }
  return Out;
}

std::size_t componentBytes(int Component) {
  switch (Component) {
  case 5120: // byte
  case 5121:
    return 1;
  case 5122: // short
  case 5123:
    return 2;
  case 5125: // unsigned int
  case 5126: // float
    return 4;
  default:
    return 0;
  }
}

std::size_t widthOf(const Json &Type) {
  const std::pair<const char *, std::size_t> Widths[] = {
      {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}};
  for (const auto &[Name, Width] : Widths)
    if (Type == Name)
      return Width;
  return 0;
}

template <std::size_t N>
bool readNumbers(const Json &Node, const char *Key, std::array<double, N> &To) {
  const auto It = Node.find(Key);
  if (It == Node.end())
    return true;
  if (!It->is_array() || It->size() != N)
    return false;
  for (std::size_t I = 0; I < N; ++I) {
    if (!(*It)[I].is_number() || !std::isfinite((*It)[I].get<double>()))
      return false;
    To[I] = (*It)[I].get<double>();
  }
  return true;
}

/// By its matrix, or by translation, rotation (x, y, z, w) and scale.
std::optional<GltfMatrix> localTransform(const Json &Node) {
  GltfMatrix M = Identity;
  if (Node.contains("matrix"))
    return readNumbers(Node, "matrix", M) && M[3] == 0 && M[7] == 0 &&
                   M[11] == 0 && M[15] == 1
               ? std::optional(M)
               : std::nullopt;
  std::array<double, 3> T{}, S{1, 1, 1};
  std::array<double, 4> Q{0, 0, 0, 1};
  if (!readNumbers(Node, "translation", T) || !readNumbers(Node, "scale", S) ||
      !readNumbers(Node, "rotation", Q))
    return std::nullopt;
  const double Norm = Q[0] * Q[0] + Q[1] * Q[1] + Q[2] * Q[2] + Q[3] * Q[3];
  if (!(Norm > 0) || !std::isfinite(Norm))
    return std::nullopt;
  const double N = 2 / Norm;
  const auto [X, Y, Z, W] = Q;
  const double R[9] = {1 - N * (Y * Y + Z * Z), N * (X * Y + W * Z),
                       N * (X * Z - W * Y),     N * (X * Y - W * Z),
                       1 - N * (X * X + Z * Z), N * (Y * Z + W * X),
                       N * (X * Z + W * Y),     N * (Y * Z - W * X),
                       1 - N * (X * X + Y * Y)};
  for (std::size_t C = 0; C < 3; ++C)
    for (std::size_t K = 0; K < 3; ++K)
      M[4 * C + K] = S[C] * R[3 * C + K];
  for (std::size_t K = 0; K < 3; ++K)
    M[12 + K] = T[K];
  return M;
}

} // namespace

std::optional<std::size_t> gltfIndex(const Json &Object, const char *Key,
                                     std::optional<std::size_t> Otherwise) {
  const auto It = Object.find(Key);
  if (It == Object.end())
    return Otherwise;
  if (!It->is_number())
    return std::nullopt;
  const auto Value = It->get<double>();
  if (!(Value >= 0 && Value <= 0x1p53) || Value != std::floor(Value))
    return std::nullopt;
  return static_cast<std::size_t>(Value);
}

double GltfAccessor::at(std::size_t Element, std::size_t Number) const {
  const std::size_t At = Element * Stride + Number * componentBytes(Component);
  const auto Scaled = [this](double Value, double Largest) {
    return Normalised ? std::max(Value / Largest, -1.0) : Value;
  };
  switch (Component) {
  case 5120:
    return Scaled(load<int8_t>(View, At), 127);
  case 5121:
    return Scaled(load<uint8_t>(View, At), 255);
  case 5122:
    return Scaled(load<int16_t>(View, At), 32767);
  case 5123:
    return Scaled(load<uint16_t>(View, At), 65535);
  case 5125:
    return load<uint32_t>(View, At);
  default:
    return load<float>(View, At);
  }
}

GltfMatrix product(const GltfMatrix &A, const GltfMatrix &B) {
  GltfMatrix M{};
  for (std::size_t C = 0; C < 4; ++C)
    for (std::size_t R = 0; R < 4; ++R)
      for (std::size_t K = 0; K < 4; ++K)
        M[4 * C + R] += A[4 * K + R] * B[4 * C + K];
  return M;
}

Expected<GltfData> GltfData::open(const std::string &Where, Bytes File,
                                  const GltfSource &Read) {
  const auto Parts = chunksOf(Where, File);
  if (!Parts)
    return Parts.error();
  // GLB pads JSON with blanks.
  auto Document = parseJson<Json>(asText(Parts->Text), Where, "glTF");
  if (!Document)
    return Document.error();
  GltfData Data;
  Data.Where = Where;
  Data.Document = std::move(*Document);
  const auto Asset = Data.Document.is_object() ? Data.Document.find("asset")
                                               : Data.Document.end();
  if (!Data.Document.is_object() || Asset == Data.Document.end() ||
      !Asset->is_object() || !Asset->contains("version") ||
      !(*Asset)["version"].is_string())
    return Data.wrong("no asset.version, expected glTF 2.0");
  if (const auto &Version = (*Asset)["version"].get_ref<const std::string &>();
      !Version.starts_with("2."))
    return Data.wrong(fmt::format("glTF {}, expected 2.0", printable(Version)));
  if (auto Done = Data.readBuffers(Parts->Binary, Parts->HasBinary, Read);
      !Done)
    return Done.error();
  return Data;
}

/// What the \p Uri of \p Owner has.
Expected<std::vector<std::byte>>
GltfData::content(const std::string &Uri, const std::string &Owner,
                  const GltfSource &Read) const {
  if (Uri.starts_with("data:")) {
    const std::size_t Comma = Uri.find(";base64,");
    auto Decoded = Comma == std::string::npos
                       ? std::nullopt
                       : decodeBase64(std::string_view(Uri).substr(Comma + 8));
    if (!Decoded)
      return wrong(fmt::format("{} has data that are not base64, expected "
                               "data:...;base64,",
                               Owner));
    return std::move(*Decoded);
  }
  const std::string Name = decodePercents(Uri);
  if (!staysInside(Name) || Name.find("://") != std::string::npos)
    return wrong(fmt::format(
        "refers to the file `{}`, expected a file inside the folder",
        printable(Name)));
  return Read(Name);
}

Expected<Success> GltfData::readBuffers(Bytes Binary, bool HasBinary,
                                        const GltfSource &Read) {
  const auto List = Document.find("buffers");
  if (List == Document.end())
    return Success{};
  if (!List->is_array())
    return wrong("buffers is not a list, expected a list");
  std::set<std::string> Names;
  for (const Json &One : *List) {
    const std::size_t Number = Buffers.size();
    const auto Length = One.is_object()
                            ? gltfIndex(One, "byteLength", std::nullopt)
                            : std::nullopt;
    if (!Length)
      return wrong(
          fmt::format("buffer {} has no byteLength, expected one", Number));
    Bytes Content;
    if (const auto Uri = One.find("uri"); Uri == One.end()) {
      if (Number != 0 || !HasBinary)
        return wrong(fmt::format("buffer {} has no uri, expected one, or a GLB "
                                 "whose second chunk it is",
                                 Number));
      Content = Binary;
    } else if (!Uri->is_string()) {
      return wrong(fmt::format("buffer {} has a uri that is not a string, "
                               "expected a file name or data",
                               Number));
    } else {
      const auto &Text = Uri->get_ref<const std::string &>();
      // Memory must follow what is there.
      if (!Text.starts_with("data:") &&
          !Names.insert(decodePercents(Text)).second)
        return wrong(fmt::format(
            "refers to the file `{}` twice, expected one reference per file",
            printable(Text)));
      auto File = content(Text, fmt::format("buffer {}", Number), Read);
      if (!File)
        return File.error();
      Owned.push_back(std::move(*File));
      Content = Owned.back();
    }
    if (Content.size() < *Length)
      return wrong(fmt::format("buffer {} has {} bytes, expected {} as its "
                               "byteLength says",
                               Number, Content.size(), *Length));
    Buffers.push_back(Content.first(*Length));
  }
  return Success{};
}

Expected<const Json *> GltfData::objectAt(const char *Key,
                                          std::size_t Index) const {
  const auto List = Document.find(Key);
  if (List == Document.end() || !List->is_array() || Index >= List->size() ||
      !(*List)[Index].is_object())
    return wrong(fmt::format(
        "no object {} in {}, expected the referenced object", Index, Key));
  return &(*List)[Index];
}

std::size_t GltfData::bytes() const {
  std::size_t Sum = 0;
  for (const Bytes &B : Buffers)
    Sum += B.size();
  return Sum;
}

Expected<Bytes> GltfData::bufferView(std::size_t Index) const {
  const auto View = objectAt("bufferViews", Index);
  if (!View)
    return View.error();
  if (const auto Extensions = (*View)->find("extensions");
      Extensions != (*View)->end() && Extensions->is_object() &&
      !Extensions->empty())
    return wrong(fmt::format("bufferView {} is packed by {}, which is not "
                             "supported, expected plain buffers",
                             Index, printable(Extensions->begin().key())));
  const auto Buffer = gltfIndex(**View, "buffer", std::nullopt),
             Offset = gltfIndex(**View, "byteOffset", 0),
             Length = gltfIndex(**View, "byteLength", std::nullopt);
  if (!Buffer || *Buffer >= Buffers.size() || !Offset || !Length ||
      *Offset > Buffers[*Buffer].size() ||
      *Length > Buffers[*Buffer].size() - *Offset)
    return wrong(fmt::format("bufferView {} is not in a buffer, expected one "
                             "that is",
                             Index));
  return Buffers[*Buffer].subspan(*Offset, *Length);
}

Expected<std::vector<std::byte>> GltfData::image(std::size_t Index,
                                                 const GltfSource &Read) const {
  const auto Image = objectAt("images", Index);
  if (!Image)
    return Image.error();
  if (const auto Uri = (*Image)->find("uri"); Uri != (*Image)->end()) {
    if (!Uri->is_string())
      return wrong(fmt::format("image {} has a uri that is not a string, "
                               "expected a file name or data",
                               Index));
    return content(Uri->get_ref<const std::string &>(),
                   fmt::format("image {}", Index), Read);
  }
  const auto View = gltfIndex(**Image, "bufferView", std::nullopt);
  if (!View)
    return wrong(fmt::format("image {} has no uri and no bufferView, expected "
                             "one of them",
                             Index));
  const auto File = bufferView(*View);
  if (!File)
    return File.error();
  return std::vector(File->begin(), File->end());
}

Expected<GltfAccessor> GltfData::accessor(std::size_t Index) const {
  const auto Found = objectAt("accessors", Index);
  if (!Found)
    return Found.error();
  const Json &J = **Found;
  const auto Bad = [&](const char *What) {
    return wrong(fmt::format("accessor {} {}", Index, What));
  };
  if (J.contains("sparse"))
    return Bad("is sparse, which is not supported, expected a dense accessor");
  const auto Number = gltfIndex(J, "bufferView", std::nullopt);
  if (!Number)
    return Bad("has no bufferView, expected one");
  const auto View = bufferView(*Number);
  if (!View)
    return View.error();
  const auto Offset = gltfIndex(J, "byteOffset", 0),
             Count = gltfIndex(J, "count", std::nullopt),
             Component = gltfIndex(J, "componentType", std::nullopt),
             Stride =
                 gltfIndex(Document["bufferViews"][*Number], "byteStride", 0);
  GltfAccessor A;
  const auto Type = J.find("type");
  A.Width = Type == J.end() ? 0 : widthOf(*Type);
  const std::size_t Each = Component && *Component < 10000
                               ? componentBytes(static_cast<int>(*Component))
                               : 0;
  if (A.Width == 0 || Each == 0)
    return Bad("has an unknown type or componentType, expected one of glTF");
  if (!Offset || !Count || !Stride)
    return Bad("has an invalid count, byteOffset or byteStride, expected whole "
               "numbers");
  A.Component = static_cast<int>(*Component);
  A.Count = *Count;
  A.Stride = *Stride == 0 ? A.Width * Each : *Stride;
  const auto Normalised = J.find("normalized");
  A.Normalised = Normalised != J.end() && *Normalised == Json(true);
  const std::size_t Size = View->size();
  if (A.Stride < A.Width * Each || *Offset > Size ||
      (A.Count > 0 &&
       (Size - *Offset < A.Width * Each ||
        A.Count - 1 > (Size - *Offset - A.Width * Each) / A.Stride)))
    return Bad("exceeds its bufferView, expected a range inside");
  A.View = View->subspan(*Offset);
  return A;
}

Expected<Success> GltfData::walk(std::size_t Node, const GltfMatrix &Parent,
                                 std::set<std::size_t> &Seen,
                                 std::vector<GltfInstance> &To) const {
  constexpr std::size_t Most = 1'000'000;
  struct Step {
    std::size_t Node;
    GltfMatrix Parent;
  };
  std::vector<Step> Left{{Node, Parent}};
  while (!Left.empty()) {
    const Step Now = Left.back();
    Left.pop_back();
    if (!Seen.insert(Now.Node).second || Seen.size() > Most)
      return wrong(fmt::format("node {} has two parents or is part of a cycle, "
                               "expected a tree of at most {} nodes",
                               Now.Node, Most));
    const auto Found = objectAt("nodes", Now.Node);
    if (!Found)
      return Found.error();
    const Json &J = **Found;
    const auto Local = localTransform(J);
    if (!Local)
      return wrong(fmt::format("node {} has an invalid transform, expected a "
                               "matrix, or translation, rotation and scale",
                               Now.Node));
    const GltfMatrix Here = product(Now.Parent, *Local);
    if (J.contains("mesh")) {
      const auto Mesh = gltfIndex(J, "mesh", std::nullopt);
      if (!Mesh)
        return wrong(fmt::format(
            "node {} has an invalid mesh, expected its index", Now.Node));
      const auto Name = J.find("name");
      To.push_back(
          {*Mesh,
           Name != J.end() && Name->is_string() ? Name->get<std::string>() : "",
           Here});
    }
    const auto Children = J.find("children");
    if (Children == J.end())
      continue;
    if (!Children->is_array())
      return wrong(fmt::format("node {} has invalid children, expected a list",
                               Now.Node));
    // The first child next.
    for (auto It = Children->rbegin(); It != Children->rend(); ++It) {
      if (!It->is_number_unsigned())
        return wrong(fmt::format(
            "node {} has an invalid child, expected its index", Now.Node));
      Left.push_back({It->get<std::size_t>(), Here});
    }
  }
  return Success{};
}

Expected<std::vector<GltfInstance>> GltfData::instances() const {
  const auto Nodes = Document.find("nodes");
  if (Nodes == Document.end() || !Nodes->is_array())
    return wrong("no nodes, expected one with a mesh of Gaussians");
  std::vector<std::size_t> Roots;
  if (const auto Scenes = Document.find("scenes"); Scenes != Document.end()) {
    const auto Number = gltfIndex(Document, "scene", 0);
    const auto Scene =
        Number ? objectAt("scenes", *Number)
               : Expected<const Json *>(wrong(
                     "scene is not a number, expected an index of scenes"));
    if (!Scene)
      return Scene.error();
    if (const auto List = (*Scene)->find("nodes"); List != (*Scene)->end()) {
      if (!List->is_array())
        return wrong("the nodes of a scene are not a list, expected a list");
      for (const Json &One : *List) {
        if (!One.is_number_unsigned())
          return wrong("a scene has an invalid node, expected its index");
        Roots.push_back(One.get<std::size_t>());
      }
    }
  } else {
    std::set<std::size_t> Children;
    for (const Json &Node : *Nodes)
      if (Node.is_object() && Node.contains("children") &&
          Node["children"].is_array())
        for (const Json &Child : Node["children"])
          if (Child.is_number_unsigned())
            Children.insert(Child.get<std::size_t>());
    for (std::size_t I = 0; I < Nodes->size(); ++I)
      if (!Children.contains(I))
        Roots.push_back(I);
  }
  std::set<std::size_t> Seen;
  std::vector<GltfInstance> Result;
  for (const std::size_t Root : Roots)
    if (auto Walked = walk(Root, Identity, Seen, Result); !Walked)
      return Walked.error();
  return Result;
}

} // namespace vorion::splat
