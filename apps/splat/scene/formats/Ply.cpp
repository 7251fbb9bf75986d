// Trained scenes in INRIA's PLY layout.
//
// A PLY, of text or binary, whose element vertex has the properties x, y, z,
// f_dc_0..2, f_rest_0.. (0, 9, 24, 45 or 72: degree 0 to 4), opacity,
// scale_0..2 and rot_0..3 as floats or doubles, in any order; other properties
// (nx, ny, nz) and other elements are skipped. Instead of f_dc and f_rest there
// may be red, green and blue as bytes, as nerfstudio writes on request: the
// colours themselves, 0.5 + C0 f_dc. Refused, each with its reason:
// missing or repeated properties, lists of a vertex, a file shorter or longer
// than the header says, values that are not finite, no vertex at all.
#include "scene/formats/Ply.h"

#include "io/PlyFile.h"
#include "io/Unsupported.h"
#include "scene/Activation.h"
#include "scene/LocalFrame.h"
#include "scene/UpDirection.h"
#include "scene/formats/Dequantize.h"
#include "scene/formats/Formats.h"
#include "scene/formats/Quantize.h"
#include "vorion/support/File.h"
#include "vorion/support/Parallel.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <string_view>
#include <vector>

namespace vorion::splat {
namespace {

/// Offsets in a vertex of what a scene needs, in the scene's order.
struct Layout {
  int ShDegree = 0;
  std::vector<PlyReal> Means, LogScales, Quats, Opacity, Sh;
  bool IsFlat = false; ///< two scales
  std::vector<std::size_t>
      ColourBytes;                  ///< of red, green, blue if there is no Sh
  std::vector<std::string> Skipped; ///< names of other properties
};

std::vector<std::string> numbered(const char *Name, int Count) {
  std::vector<std::string> Names;
  Names.reserve(static_cast<std::size_t>(Count));
  for (int I = 0; I < Count; ++I)
    Names.push_back(fmt::format("{}_{}", Name, I));
  return Names;
}

/// Viewers write these for others; a scene's own colours and shapes are in
/// what is read.
bool isIgnored(std::string_view Name) {
  constexpr std::array<std::string_view, 7> Names{
      "nx", "ny", "nz", "red", "green", "blue", "alpha"};
  return std::ranges::find(Names, Name) != Names.end();
}

/// Whether the colours are bytes.
bool hasColourBytes(const PlyElement &Vertex) {
  return !Vertex.find("f_dc_0") && Vertex.find("red") &&
         Vertex.find("red")->Type == PlyType::UChar;
}

/// What a PLY without anything that only Gaussians have is.
std::optional<Error> pointsOrMesh(const std::string &Where,
                                  const PlyHeader &Header,
                                  const PlyElement &Vertex) {
  for (const char *Name : {"opacity", "scale_0", "rot_0", "f_dc_0", "f_rest_0"})
    if (Vertex.find(Name))
      return std::nullopt;
  return Error{
      Where,
      fmt::format("{}: element vertex has no opacity, scale_0 or rot_0, "
                  "expected a scene of Gaussians; `splat train` makes one from "
                  "photographs whose cameras are known",
                  Header.find("face") ? "a mesh" : "a point cloud")};
}

/// Finds the needed properties; the degree follows from the number of f_rest.
Expected<Layout> layoutOf(const std::string &Where, const PlyElement &Vertex) {
  Layout L;
  const auto Rest = static_cast<std::size_t>(std::count_if(
      Vertex.Properties.begin(), Vertex.Properties.end(),
      [](const PlyProperty &P) { return P.Name.starts_with("f_rest_"); }));
  L.ShDegree = Rest % 3 == 0 ? shDegreeOf(Rest / 3) : -1;
  if (L.ShDegree < 0)
    return Error{Where,
                 fmt::format("{} f_rest properties, expected 0, 9, 24, 45 or "
                             "72 (degree 0 to 4)",
                             Rest)};
  std::vector<std::string> ShNames;
  if (Rest == 0 && hasColourBytes(Vertex)) {
    auto Found =
        Vertex.offsets(Where, {"red", "green", "blue"}, PlyType::UChar);
    if (!Found)
      return Found.error();
    L.ColourBytes = std::move(*Found);
  } else {
    ShNames = numbered("f_dc", 3);
    for (std::string &Name : plyRestNames(L.ShDegree))
      ShNames.push_back(std::move(Name));
  }

  L.IsFlat = Vertex.find("scale_1") && !Vertex.find("scale_2");
  const struct {
    std::vector<PlyReal> &To;
    std::vector<std::string> Names;
  } Needed[] = {{L.Means, {"x", "y", "z"}},
                {L.LogScales, numbered("scale", L.IsFlat ? 2 : 3)},
                {L.Quats, numbered("rot", 4)},
                {L.Opacity, {"opacity"}},
                {L.Sh, std::move(ShNames)}};
  std::set<std::string> Known;
  for (const auto &[To, Names] : Needed) {
    auto Found = Vertex.reals(Where, Names);
    if (!Found)
      return Found.error();
    To = std::move(*Found);
    Known.insert(Names.begin(), Names.end());
  }
  for (const PlyProperty &P : Vertex.Properties) {
    if (const auto Meaning = unsupportedProperty(P.Name))
      return Error{
          Where,
          fmt::format(
              "property {} of element {} requires {}, which is not supported",
              P.Name, Vertex.Name, *Meaning)};
    if (!Known.contains(P.Name) && !isIgnored(P.Name))
      L.Skipped.push_back(P.Name);
  }
  return L;
}

/// The rows of \p Vertex as a scene.
void readRows(const PlyFile &File, const PlyElement &Vertex, const Layout &L,
              Scene &S, const std::function<void(Bytes)> &Done) {
  S.ShDegree = L.ShDegree;
  struct Parameter {
    std::vector<float> &To;
    const std::vector<PlyReal> &From;
    std::size_t Each;
  };
  std::vector<Parameter> Copied{{S.LogScales, L.LogScales, 3},
                                {S.Quats, L.Quats, 4},
                                {S.OpacityLogits, L.Opacity, 1},
                                {S.Sh, L.Sh, 3 * S.coefficients()}};
  if (std::ranges::none_of(L.Means, &PlyReal::IsDouble)) {
    Copied.push_back({S.Means, L.Means, 3});
  } else {
    S.Means.resize(3 * Vertex.Count);
    for (std::size_t K = 0; K < S.Means.size(); ++K)
      S.setMean(K, loadReal(File.row(Vertex, K / 3), L.Means[K % 3]));
  }
  for (const auto &[To, From, Each] : Copied)
    To.reserve(Each * Vertex.Count);
  // The scene's memory grows as the file's shrinks: some megabytes at a time,
  // which a processor's cache holds.
  constexpr std::size_t AtOnce = std::size_t{1} << 15, OfThread = 1 << 12;
  for (std::size_t Begin = 0; Begin < Vertex.Count; Begin += AtOnce) {
    const std::size_t Count = std::min(AtOnce, Vertex.Count - Begin);
    for (const auto &[To, From, Each] : Copied)
      To.resize(Each * (Begin + Count), FlatLogScale);
    inParallelParts(Count, OfThread, [&](std::size_t First, std::size_t End) {
      for (std::size_t I = Begin + First; I < Begin + End; ++I) {
        const Bytes Row = File.row(Vertex, I);
        for (const auto &[To, From, Each] : Copied)
          for (std::size_t K = 0; K < From.size(); ++K)
            To[I * Each + K] = static_cast<float>(loadReal(Row, From[K]));
        for (std::size_t C = 0; C < L.ColourBytes.size(); ++C)
          S.Sh[3 * I + C] = shOfColor(byteAt(Row, L.ColourBytes[C]) / 255.0);
      }
    });
    // Others were converted to rows of their own.
    if (File.header().Encoding == PlyEncoding::LittleEndian)
      Done(File.from(Vertex).subspan(Begin * Vertex.Stride,
                                     Count * Vertex.Stride));
  }
}

} // namespace

std::vector<std::string> plyRestNames(int ShDegree) {
  std::vector<std::string> Names;
  const std::size_t Later = shCoefficients(ShDegree) - 1;
  for (std::size_t K = 0; K < Later; ++K)
    for (std::size_t C = 0; C < 3; ++C)
      Names.push_back(fmt::format("f_rest_{}", C * Later + K));
  return Names;
}

bool isPly(Bytes File) { return isPlyFile(File) && !isCompressedPly(File); }

Expected<SceneFile> parsePly(const std::string &Where, Bytes File,
                             const ReadOptions &Options) {
  return parsePly(Where, File, Options, [](Bytes) {});
}

Expected<SceneFile> parsePly(const std::string &Where, Bytes File,
                             const ReadOptions & /*Options*/,
                             const std::function<void(Bytes)> &Done) {
  const auto Read = readPly(Where, File);
  if (!Read)
    return Read.error();
  auto DrawnAs = drawingOfComments(Where, Read->header().Comments);
  if (!DrawnAs)
    return DrawnAs.error();
  const PlyElement *Vertex = Read->header().find("vertex");
  if (!Vertex)
    return Error{Where, "no element vertex, expected `element vertex <count>`, "
                        "or chunk and vertex of a compressed PLY"};
  if (Vertex->HasLists)
    return Error{Where, "element vertex has a list, expected numbers"};
  if (auto Other = pointsOrMesh(Where, Read->header(), *Vertex))
    return *Other;
  const auto L = layoutOf(Where, *Vertex);
  if (!L)
    return L.error();

  SceneFile Result;
  Result.Format = SceneFormat::Ply;
  Result.DrawnAs = std::move(*DrawnAs);
  if (L->IsFlat) // 2D Gaussians
    Result.DrawnAs.Renderer = RendererKind::Surfel;
  Result.Up = upOfComments(Read->header().Comments);
  Result.Skipped = L->Skipped;
  for (const PlyElement &E : Read->header().Elements)
    if (&E != Vertex)
      Result.Skipped.push_back("element " + E.Name);
  readRows(*Read, *Vertex, *L, Result.Gaussians, Done);
  return Result;
}

/// As other programs write 2D Gaussians.
static bool hasTwoScales(const Scene &S, const Drawing &D) {
  if (D.Renderer != RendererKind::Surfel)
    return false;
  for (std::size_t I = 0; I < S.size(); ++I)
    if (S.LogScales[3 * I + 2] != FlatLogScale)
      return false;
  return true;
}

std::string formatPly(const Scene &S, const Drawing &D) {
  const std::size_t Later = S.coefficients() - 1;
  std::string Out =
      fmt::format("ply\nformat binary_little_endian 1.0\n{}element vertex {}\n",
                  drawingComments(D), S.size());
  const auto Declare = [&](const std::string &Name) {
    Out += fmt::format("property float {}\n", Name);
  };
  const bool InDoubles = needsDoubles(S);
  for (const char *Name : {"x", "y", "z"})
    Out +=
        fmt::format("property {} {}\n", InDoubles ? "double" : "float", Name);
  for (const char *Name : {"nx", "ny", "nz"})
    Declare(Name);
  for (int C = 0; C < 3; ++C)
    Declare(fmt::format("f_dc_{}", C));
  for (std::size_t K = 0; K < 3 * Later; ++K)
    Declare(fmt::format("f_rest_{}", K));
  Declare("opacity");
  const std::size_t Scales = hasTwoScales(S, D) ? 2 : 3;
  for (std::size_t C = 0; C < Scales; ++C)
    Declare(fmt::format("scale_{}", C));
  for (int C = 0; C < 4; ++C)
    Declare(fmt::format("rot_{}", C));
  Out += "end_header\n";

  const auto Put = [&](const float *Values, std::size_t Count) {
    Out.append(reinterpret_cast<const char *>(Values), Count * sizeof(float));
  };
  const std::array<float, 3> NoNormal{};
  for (std::size_t I = 0; I < S.size(); ++I) {
    for (std::size_t K = 3 * I; K < 3 * I + 3; ++K)
      if (InDoubles)
        put(Out, S.mean(K));
      else
        put(Out, S.roundedMean(K));
    Put(NoNormal.data(), 3);
    const float *Sh = &S.Sh[3 * (Later + 1) * I];
    Put(Sh, 3);
    for (std::size_t C = 0; C < 3; ++C)
      for (std::size_t K = 1; K <= Later; ++K)
        Put(Sh + 3 * K + C, 1);
    Put(&S.OpacityLogits[I], 1);
    Put(&S.LogScales[3 * I], Scales);
    Put(&S.Quats[4 * I], 4);
  }
  return Out;
}

Expected<Success> writePly(const std::string &Path, const Scene &S,
                           const Drawing &D) {
  return writeFileAtomically(Path, formatPly(S, D));
}

} // namespace vorion::splat
