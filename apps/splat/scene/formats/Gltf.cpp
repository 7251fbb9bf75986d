// glTF's axes are kept: +y up, +z to the front. Scales and opacities are stored
// as they are drawn, quaternions as x, y, z, w.
#include "scene/formats/Gltf.h"

#include "scene/Edit.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"
#include "scene/formats/GltfData.h"
#include "scene/formats/SogFolder.h"
#include "vorion/support/File.h"
#include "vorion/support/FileKind.h"
#include "vorion/support/Json.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <limits>
#include <optional>

namespace vorion::splat {
namespace {

using Json = nlohmann::json;

constexpr const char *Splatting = "KHR_gaussian_splatting";
/// Where an `.spz` is, in the extension's extensions; of drafts, in the
/// primitive's.
constexpr const char *SpzNames[] = {"KHR_gaussian_splatting_compression_spz",
                                    "KHR_gaussian_splatting_compression_spz_2",
                                    "KHR_spz_gaussian_splats_compression",
                                    "KHR_spz_compression"};

/// Extensions that change nothing about Gaussians.
bool isHarmless(const std::string &Name) {
  for (const char *Start : {"KHR_materials_", "KHR_texture_", "EXT_texture_",
                            "KHR_lights_", "KHR_mesh_quantization",
                            "EXT_mesh_features", "EXT_structural_metadata"})
    if (Name.starts_with(Start))
      return true;
  return false;
}

bool isKnown(const std::string &Name) {
  return Name == Splatting || isHarmless(Name) ||
         std::ranges::find(SpzNames, Name) != std::end(SpzNames);
}

/// \p Object's object \p Key, or nullptr.
const Json *objectIn(const Json &Object, const char *Key) {
  const auto It = Object.find(Key);
  return It != Object.end() && It->is_object() ? &*It : nullptr;
}

/// One primitive with Gaussians.
class Primitive {
public:
  Primitive(const std::string &Where, std::string Name, const GltfData &Data,
            const Json &J, const ReadOptions &Options)
      : Where(Where), Name(std::move(Name)), Data(Data), J(J),
        Options(Options) {}

  Expected<Scene> read(std::set<std::size_t> &SpzRead, std::size_t &Left);

private:
  Error wrong(const std::string &What) const {
    return {Where, Name + ": " + What};
  }
  Expected<Success> checkExtension(const Json &Extension) const;
  /// The accessor of the first of \p Names that there is; nothing if none is.
  Expected<std::optional<GltfAccessor>>
  attribute(std::initializer_list<std::string> Names, std::size_t Width) const;
  Expected<GltfAccessor> needed(std::initializer_list<std::string> Names,
                                std::size_t Width) const;
  Expected<Scene> readPlain(std::size_t &Left);
  Expected<Success> readHarmonics(Scene &S) const;

  const std::string &Where;
  std::string Name;
  const GltfData &Data;
  const Json &J;
  const ReadOptions &Options;
};

Expected<Success> Primitive::checkExtension(const Json &Extension) const {
  const struct {
    const char *Key, *Known;
  } Values[] = {{"kernel", "ellipse"},
                {"colorSpace", "srgb_rec709_display"},
                {"projection", "perspective"},
                {"sortingMethod", "cameraDistance"}};
  for (const auto &[Key, Known] : Values)
    if (const auto It = Extension.find(Key);
        It != Extension.end() && *It != Known)
      return wrong(fmt::format("{} {} is not supported, expected \"{}\"", Key,
                               printable(jsonText(*It)), Known));
  // Drafts had scales of quantised positions here.
  for (const auto &[Key, Value] : Extension.items())
    if (Key != "extensions" && Key != "extras" &&
        std::ranges::none_of(Values,
                             [&](const auto &V) { return Key == V.Key; }))
      return wrong(fmt::format("{} is unknown, expected a property of {}",
                               printable(Key), Splatting));
  return Success{};
}

Expected<std::optional<GltfAccessor>>
Primitive::attribute(std::initializer_list<std::string> Names,
                     std::size_t Width) const {
  const Json *Attributes = objectIn(J, "attributes");
  for (const std::string &Each : Names) {
    if (!Attributes || !Attributes->contains(Each))
      continue;
    const auto Number = gltfIndex(*Attributes, Each.c_str(), std::nullopt);
    if (!Number)
      return wrong(fmt::format(
          "attribute {} is not a number, expected the index of an accessor",
          Each));
    auto A = Data.accessor(*Number);
    if (!A)
      return A.error();
    if (A->Width != Width)
      return wrong(
          fmt::format("attribute {} has {} numbers per element, expected {}",
                      Each, A->Width, Width));
    return std::optional(*A);
  }
  return std::optional<GltfAccessor>();
}

Expected<GltfAccessor>
Primitive::needed(std::initializer_list<std::string> Names,
                  std::size_t Width) const {
  auto A = attribute(Names, Width);
  if (!A)
    return A.error();
  if (!*A)
    return wrong(
        fmt::format("attribute {} is missing, expected it", *Names.begin()));
  return **A;
}

std::string prefixed(const std::string &Name) {
  return std::string(Splatting) + ":" + Name;
}

Expected<Success> Primitive::readHarmonics(Scene &S) const {
  std::vector<GltfAccessor> Bands;
  int Degree = 0;
  for (int Band = 1; Band <= MaxStoredShDegree; ++Band) {
    std::size_t Found = 0;
    for (int K = 0; K < 2 * Band + 1; ++K) {
      const std::string Each = fmt::format("SH_DEGREE_{}_COEF_{}", Band, K);
      const auto A = attribute({prefixed(Each), "_" + Each}, 3);
      if (!A)
        return A.error();
      if (!*A)
        continue;
      if ((*A)->Count != S.size())
        return wrong(fmt::format("attribute {} has {} elements, expected {}",
                                 Each, (*A)->Count, S.size()));
      ++Found;
      Bands.push_back(**A);
    }
    if (Found == 0)
      continue;
    if (Found != 2 * static_cast<std::size_t>(Band) + 1 || Degree != Band - 1)
      return wrong(
          fmt::format("spherical harmonics of degree {} are incomplete, "
                      "expected all coefficients up to this degree",
                      Band));
    Degree = Band;
  }
  if (Degree == 0)
    return Success{};
  setShDegree(S, Degree);
  const std::size_t Each = 3 * S.coefficients();
  for (std::size_t I = 0; I < S.size(); ++I)
    for (std::size_t K = 0; K < Bands.size(); ++K)
      for (std::size_t C = 0; C < 3; ++C)
        S.Sh[Each * I + 3 * (K + 1) + C] =
            static_cast<float>(Bands[K].at(I, C));
  return Success{};
}

Expected<Scene> Primitive::readPlain(std::size_t &Left) {
  const auto Position = needed({"POSITION"}, 3);
  if (!Position)
    return Position.error();
  const auto Rotation = needed({prefixed("ROTATION"), "_ROTATION"}, 4);
  if (!Rotation)
    return Rotation.error();
  const auto Size = needed({prefixed("SCALE"), "_SCALE"}, 3);
  if (!Size)
    return Size.error();
  // Drafts had the colour and the opacity in COLOR_0.
  const auto Base =
      attribute({prefixed("SH_DEGREE_0_COEF_0"), "_SH_DEGREE_0_COEF_0"}, 3);
  if (!Base)
    return Base.error();
  const auto Opacity = attribute({prefixed("OPACITY"), "_OPACITY"}, 1);
  if (!Opacity)
    return Opacity.error();
  std::optional<GltfAccessor> Colour;
  if (!*Base || !*Opacity) {
    const auto Found = needed({"COLOR_0"}, 4);
    if (!Found)
      return Found.error();
    Colour = *Found;
  }
  const std::size_t Count = Position->Count;
  for (const GltfAccessor *A :
       {&*Rotation, &*Size, *Base ? &**Base : &*Position,
        *Opacity ? &**Opacity : &*Position, Colour ? &*Colour : &*Position})
    if (A->Count != Count)
      return wrong(fmt::format(
          "attributes have {} and {} elements, expected equal numbers", Count,
          A->Count));
  // Many primitives may name the same numbers.
  if (Count > Left)
    return wrong("more Gaussians than its buffers can contain, expected one "
                 "reference per Gaussian");
  Left -= Count;
  Scene S = Scene::sized(Count, 0);
  for (std::size_t I = 0; I < Count; ++I) {
    for (std::size_t A = 0; A < 3; ++A) {
      S.Means[3 * I + A] = static_cast<float>(Position->at(I, A));
      const double Extent = Size->at(I, A);
      if (Extent < 0)
        return wrong(fmt::format("Gaussian {} has a scale of {}, expected 0 or "
                                 "more",
                                 I, Extent));
      S.LogScales[3 * I + A] = static_cast<float>(std::log(
          std::max<double>(Extent, std::numeric_limits<float>::min())));
      if (std::isnan(Extent))
        S.LogScales[3 * I + A] = std::numeric_limits<float>::quiet_NaN();
      S.Sh[3 * I + A] = *Base ? static_cast<float>((*Base)->at(I, A))
                              : shOfColor(Colour->at(I, A));
    }
    for (std::size_t K = 0; K < 4; ++K)
      S.Quats[4 * I + (K + 1) % 4] = static_cast<float>(Rotation->at(I, K));
    const double Alpha = *Opacity ? (*Opacity)->at(I, 0) : Colour->at(I, 3);
    if (!(Alpha >= 0 && Alpha <= 1) && !std::isnan(Alpha))
      return wrong(fmt::format("Gaussian {} has an opacity of {}, expected 0 "
                               "to 1",
                               I, Alpha));
    S.OpacityLogits[I] = std::isnan(Alpha)
                             ? std::numeric_limits<float>::quiet_NaN()
                             : opacityLogit(Alpha);
  }
  if (auto Read = readHarmonics(S); !Read)
    return Read.error();
  return S;
}

Expected<Scene> Primitive::read(std::set<std::size_t> &SpzRead,
                                std::size_t &Left) {
  const Json &Own = J["extensions"];
  const Json *Extension = objectIn(Own, Splatting);
  if (Extension)
    if (auto Checked = checkExtension(*Extension); !Checked)
      return Checked.error();
  const Json *Inner = Extension ? objectIn(*Extension, "extensions") : nullptr;
  for (const Json *Holder : {Inner, &Own})
    for (const char *Each : SpzNames) {
      const Json *Spz = Holder ? objectIn(*Holder, Each) : nullptr;
      if (!Spz)
        continue;
      const auto Number = gltfIndex(*Spz, "bufferView", std::nullopt);
      if (!Number || !SpzRead.insert(*Number).second)
        return wrong(fmt::format("{} has no bufferView, expected one", Each));
      const auto View = Data.bufferView(*Number);
      if (!View)
        return View.error();
      if (!isSpz(*View))
        return wrong(
            fmt::format("bufferView {} is not an .spz, expected one", *Number));
      auto Read = parseSpz(Where + ": " + Name, *View, Options);
      if (!Read)
        return Read.error();
      return std::move(Read->Gaussians);
    }
  if (Inner && !Inner->empty())
    return wrong(fmt::format("extension {} is not supported, expected plain "
                             "attributes or SPZ",
                             printable(Inner->begin().key())));
  return readPlain(Left);
}

/// Moves \p S by \p M.
Expected<Success> place(const std::string &Where, const std::string &Name,
                        Scene &S, const GltfMatrix &M) {
  if (!std::ranges::all_of(M, [](double V) { return std::isfinite(V); }))
    return Error{Where, Name + ": the product of its nodes' transforms is not "
                               "finite, expected smaller transforms"};
  Affine By;
  for (std::size_t C = 0; C < 3; ++C) {
    for (std::size_t R = 0; R < 3; ++R)
      By.Matrix[R][C] = M[4 * C + R];
    By.Translation[C] = M[12 + C];
  }
  deform(S, By);
  return Success{};
}

/// Whether \p M scales all lengths to 0, which hides a node.
bool isHidden(const GltfMatrix &M) {
  return std::all_of(M.begin(), M.begin() + 12,
                     [](double V) { return V == 0; });
}

Expected<Success> checkRequired(const std::string &Where, const Json &J) {
  const auto List = J.find("extensionsRequired");
  if (List == J.end() || !List->is_array())
    return Success{};
  for (const Json &One : *List)
    if (!One.is_string() || !isKnown(One.get<std::string>()))
      return Error{Where,
                   fmt::format("requires {}, which is not supported, expected "
                               "{} with plain buffers or SPZ",
                               printable(jsonText(One)), Splatting)};
  return Success{};
}

bool hasGaussians(const Json &Primitive) {
  const Json *Own =
      Primitive.is_object() ? objectIn(Primitive, "extensions") : nullptr;
  return Own && (Own->contains(Splatting) ||
                 std::ranges::any_of(SpzNames, [&](const char *Name) {
                   return Own->contains(Name);
                 }));
}

} // namespace

bool isGltf(Bytes File) {
  const std::string_view Text = asText(File);
  if (hasMark(FileKind::Glb, File))
    return true;
  const std::size_t Start = Text.find_first_not_of(" \t\r\n");
  return Start != std::string_view::npos && Text[Start] == '{' &&
         Text.find("\"asset\"") != std::string_view::npos && !isSogJson(File);
}

Expected<SceneFile> parseGltfFiles(const std::string &Where, Bytes File,
                                   const GltfSource &Read,
                                   const ReadOptions &Options) {
  const auto Data = GltfData::open(Where, File, Read);
  if (!Data)
    return Data.error();
  if (auto Checked = checkRequired(Where, Data->document()); !Checked)
    return Checked.error();
  const auto Instances = Data->instances();
  if (!Instances)
    return Instances.error();
  SceneFile Result;
  Result.Format = SceneFormat::Gltf;
  Result.Version = 2;
  std::set<std::size_t> SpzRead;
  std::size_t Left = Data->bytes(), Hidden = 0;
  bool IsFirst = true;
  for (const GltfInstance &Each : *Instances) {
    if (isHidden(Each.Transform)) {
      ++Hidden;
      continue;
    }
    const auto Mesh = Data->objectAt("meshes", Each.Mesh);
    if (!Mesh)
      return Mesh.error();
    const auto Primitives = (*Mesh)->find("primitives");
    if (Primitives == (*Mesh)->end() || !Primitives->is_array())
      return Error{Where, fmt::format("mesh {} has no primitives, expected a "
                                      "list",
                                      Each.Mesh)};
    for (std::size_t P = 0; P < Primitives->size(); ++P) {
      const Json &One = (*Primitives)[P];
      if (!hasGaussians(One)) {
        ++Result.Meshes;
        continue;
      }
      const std::string Name =
          fmt::format("mesh {} primitive {}", Each.Mesh, P);
      auto S = Primitive(Where, Name, *Data, One, Options).read(SpzRead, Left);
      if (!S)
        return S.error();
      limitShDegree(*S, Result.ReducedFrom);
      if (auto Placed = place(Where, Name, *S, Each.Transform); !Placed)
        return Placed.error();
      if (IsFirst)
        Result.Gaussians = std::move(*S);
      else
        join(Result.Gaussians, std::move(*S));
      IsFirst = false;
    }
  }
  if (IsFirst)
    return Error{Where,
                 fmt::format("no primitive with {}, expected one", Splatting)};
  if (Hidden > 0)
    Result.Skipped.push_back(
        fmt::format("{} meshes that a scale of 0 hides", Hidden));
  return Result;
}

Expected<SceneFile> parseGltf(const std::string &Where, Bytes File,
                              const ReadOptions &Options) {
  return parseGltfFiles(
      Where, File,
      [&](const std::string &Name) -> Expected<std::vector<std::byte>> {
        return Error{
            Where,
            fmt::format("needs the file `{}`, expected a self-contained file",
                        printable(Name))};
      },
      Options);
}

GltfSource filesBeside(const std::string &Path) {
  return [Folder = std::filesystem::path(Path).parent_path()](
             const std::string &Name) {
    return readRegularFile((Folder / Name).string());
  };
}

Expected<SceneFile> readGltf(const std::string &Path, Bytes File,
                             const ReadOptions &Options) {
  return parseGltfFiles(Path, File, filesBeside(Path), Options);
}

} // namespace vorion::splat
