#include "scene/SceneWriter.h"

#include "io/Gzip.h"
#include "io/Hash.h"
#include "scene/Activation.h"
#include "scene/Edit.h"
#include "scene/MortonOrder.h"
#include "scene/SceneFile.h"
#include "scene/formats/GltfWriter.h"
#include "scene/formats/Ply.h"
#include "scene/formats/Sog.h"
#include "scene/formats/Writers.h"
#include "vorion/support/File.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <span>
#include <utility>

namespace vorion::splat {
namespace {

/// A format that can be written: the longest ending that fits decides.
struct Writer {
  std::string_view Ending;
  bool InMortonOrder;
  /// Null for a SOG's folder, which is several files, and for glTF.
  Expected<std::string> (*Format)(const Scene &S, const Drawing &D);
};

Expected<std::string> spzOf(const Scene &S, const Drawing &D) {
  if (!fitsSpz(S))
    return Error{"", "the scene is larger than 16 million units, the limit of "
                     ".spz, expected a smaller scene or another format"};
  return gzipOf(spzBodyOf(S, 3, D));
}

/// Of a SOG's folder, beside whose pictures it lies.
constexpr std::string_view SogIndex = "meta.json";

constexpr std::string_view Glb = ".glb";

constexpr std::size_t InriasPly = 1;
const Writer Writers[] = {
    {".compressed.ply", true,
     [](const Scene &S, const Drawing &D) -> Expected<std::string> {
       return compressedPlyOf(S, D);
     }},
    {".ply", false, // InriasPly
     [](const Scene &S, const Drawing &D) -> Expected<std::string> {
       return formatPly(S, D);
     }},
    {".splat", false,
     [](const Scene &S, const Drawing & /*D*/) -> Expected<std::string> {
       return splatOf(S);
     }},
    {".spz", false, spzOf},
    // Neighbours in space are neighbours in the pictures.
    {".sog", true, sogArchiveOf},
    {Glb, false, nullptr},
    {SogIndex, true, nullptr}};

Expected<std::string> glbOf(const Scene &S,
                            const std::function<void(GltfWriter &)> &AddMore) {
  GltfWriter W;
  W.addGaussians(S);
  if (AddMore)
    AddMore(W);
  return W.finish();
}

const Writer &writerOf(std::string_view Path) {
  const auto *Found = std::ranges::find_if(
      Writers, [&](const Writer &W) { return Path.ends_with(W.Ending); });
  return Found == std::end(Writers) ? Writers[InriasPly] : *Found;
}

double largestDifference(const std::vector<float> &A,
                         const std::vector<float> &B) {
  double Most = 0;
  for (std::size_t I = 0; I < A.size(); ++I)
    Most = std::max(Most, std::abs(double(A[I]) - B[I]));
  return Most;
}

/// What has been written, as its reader sees it.
WrittenScene writtenOf(SceneFile Read, const Scene &Given, const Drawing &D,
                       std::string Hash) {
  WrittenScene Result;
  Result.Hash = std::move(Hash);
  Result.ShDegree = Read.Gaussians.ShDegree;
  Result.KeepsDrawing = Read.DrawnAs.drawsAs(D);
  Scene Kept = std::move(Read.Gaussians);
  // What the file has no harmonics for, it has zeros for.
  setShDegree(Kept, Given.ShDegree);
  Result.Lost = differenceOf(Given, Kept);
  return Result;
}

/// \p Path is the folder's index, which names the pictures beside it.
Expected<WrittenScene> writeSogFolder(const std::string &Path, const Scene &S,
                                      const Drawing &D) {
  namespace fs = std::filesystem;
  if (fs::path(Path).filename() != SogIndex)
    return Error{
        Path, fmt::format("not the name of a SOG index, expected {}", SogIndex),
        ExitCode::Usage};
  const auto Files = sogFilesOf(S, D);
  if (!Files)
    return Error{Path, Files.error().What, Files.error().Code};
  const std::string &Index = Files->at(std::string(SogIndex));
  auto Read = parseSogData(
      Path, Path, std::as_bytes(std::span(Index)),
      [&](const std::string &Name,
          std::size_t /*Most*/) -> Expected<std::vector<std::byte>> {
        const auto Bytes = std::as_bytes(std::span(Files->at(Name)));
        return std::vector<std::byte>(Bytes.begin(), Bytes.end());
      });
  if (!Read)
    return Read.error();
  std::string Hashes; // of a map: in the order of names
  std::vector<FileContent> Parts;
  for (const auto &[Name, Bytes] : *Files) {
    Hashes += fmt::format("{} {}\n", fnv1a64(Bytes), Name);
    if (Name != SogIndex)
      Parts.push_back({(fs::path(Path).parent_path() / Name).string(), Bytes});
  }
  Parts.push_back({Path, Index});
  if (auto Written = writeFilesTogether(Parts); !Written)
    return Written.error();
  return writtenOf(std::move(*Read), S, D, fnv1a64(Hashes));
}

} // namespace

const std::vector<std::string_view> &writtenEndings() {
  static const std::vector<std::string_view> Endings = [] {
    std::vector<std::string_view> Result;
    for (const Writer &W : Writers)
      Result.push_back(W.Ending);
    return Result;
  }();
  return Endings;
}

std::vector<std::pair<std::string_view, double>>
byName(const SceneDifference &D) {
  return {{"position", D.Position}, {"log_scale", D.LogScale},
          {"rotation", D.Rotation}, {"opacity", D.Opacity},
          {"color", D.Color},       {"harmonics", D.Harmonics}};
}

SceneDifference differenceOf(const Scene &A, const Scene &B) {
  SceneDifference D;
  for (std::size_t I = 0; I < A.Means.size(); ++I)
    D.Position = std::max(D.Position, std::abs(A.mean(I) - B.mean(I)));
  D.LogScale = largestDifference(A.LogScales, B.LogScales);
  auto X = activate<double>(A), Y = activate<double>(B);
  for (std::size_t I = 0; I < A.size(); ++I) {
    D.Opacity = std::max(D.Opacity, std::abs(X.Opacities[I] - Y.Opacities[I]));
    for (auto *Quats : {&X.Quats, &Y.Quats}) { // zeros are no rotation
      double *Q = &(*Quats)[4 * I];
      if (std::all_of(Q, Q + 4, [](double V) { return V == 0; }))
        Q[0] = 1;
    }
    double Dot = 0;
    for (std::size_t K = 4 * I; K < 4 * I + 4; ++K)
      Dot += X.Quats[K] * Y.Quats[K];
    for (std::size_t K = 4 * I; K < 4 * I + 4; ++K)
      D.Rotation =
          std::max(D.Rotation,
                   std::abs(X.Quats[K] - (Dot < 0 ? -Y.Quats[K] : Y.Quats[K])));
  }
  const std::size_t Each = 3 * A.coefficients();
  for (std::size_t I = 0; I < A.Sh.size(); ++I) {
    double &To = I % Each < 3 ? D.Color : D.Harmonics;
    To = std::max(To, std::abs(double(A.Sh[I]) - B.Sh[I]));
  }
  return D;
}

Expected<WrittenScene>
writeScene(const std::string &Path, const Scene &S, const Drawing &D,
           const std::function<void(GltfWriter &)> &AddMore) {
  const Writer &W = writerOf(Path);
  Scene Ordered;
  if (W.InMortonOrder) {
    Ordered = S;
    putInMortonOrder(Ordered);
  }
  const Scene &Given = W.InMortonOrder ? Ordered : S;
  if (W.Ending == SogIndex)
    return writeSogFolder(Path, Given, D);
  const auto File =
      W.Ending == Glb ? glbOf(Given, AddMore) : W.Format(Given, D);
  if (!File)
    return Error{Path, File.error().What, File.error().Code};
  auto Read = parseScene(Path, std::as_bytes(std::span(*File)));
  if (!Read)
    return Read.error();
  if (auto Written = writeFileAtomically(Path, *File); !Written)
    return Written.error();
  return writtenOf(std::move(*Read), Given, D, fnv1a64(*File));
}

} // namespace vorion::splat
