#include "mesh/Mesh.h"

#include "io/PlyHeader.h"
#include "scene/formats/Formats.h"
#include "vorion/support/File.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <iterator>
#include <string_view>
#include <utility>

namespace vorion::splat {

uint32_t Mesh::addVertex(const std::array<float, 3> &Position,
                         const std::array<float, 4> &Color) {
  const auto Number = static_cast<uint32_t>(vertices());
  Positions.insert(Positions.end(), Position.begin(), Position.end());
  Colors.insert(Colors.end(), Color.begin(), Color.end());
  return Number;
}

bool Mesh::has(AlphaMode Mode) const {
  return std::ranges::any_of(
      MaterialOf, [&](uint32_t M) { return Materials[M].Alpha == Mode; });
}

const MeshPart &Mesh::partOf(std::size_t Triangle) const {
  return *std::prev(
      std::ranges::upper_bound(Parts, Triangle, {}, &MeshPart::First));
}

void Mesh::beginPart(std::string_view Name) {
  // One without triangles is none.
  if (Parts.back().First != triangles())
    Parts.push_back({Parts.back().File, "", triangles(), triangles()});
  Parts.back().Name = printable(Name);
}

void Mesh::addPolygon(std::span<const MeshCorner> Polygon, uint32_t Look) {
  const bool HasTexture = hasTextures() || Materials[Look].Picture;
  const bool HasNormals =
      !Normals.empty() || std::ranges::any_of(Polygon, [](const MeshCorner &C) {
        return C.Normal != std::array<float, 3>{};
      });
  // Those of the triangles before have none.
  if (HasTexture)
    TextureCoordinates.resize(2 * Corners.size());
  if (HasNormals)
    Normals.resize(3 * Corners.size());
  for (std::size_t I = 2; I < Polygon.size(); ++I) {
    for (const std::size_t K : {std::size_t{0}, I - 1, I}) {
      const MeshCorner &C = Polygon[K];
      Corners.push_back(C.Vertex);
      if (HasTexture)
        TextureCoordinates.insert(TextureCoordinates.end(),
                                  C.TextureCoordinate.begin(),
                                  C.TextureCoordinate.end());
      if (HasNormals)
        Normals.insert(Normals.end(), C.Normal.begin(), C.Normal.end());
    }
    MaterialOf.push_back(Look);
  }
}

void Mesh::append(Mesh Other) {
  const auto FirstVertex = static_cast<uint32_t>(vertices()),
             FirstLook = static_cast<uint32_t>(Materials.size()),
             FirstTexture = static_cast<uint32_t>(Textures.size());
  const auto Join = [](auto &To, const auto &From) {
    To.insert(To.end(), From.begin(), From.end());
  };
  // Those without have zeros beside those with.
  const std::size_t Before = Corners.size(),
                    After = Before + Other.Corners.size();
  if (hasTextures() || Other.hasTextures()) {
    TextureCoordinates.resize(2 * Before);
    Join(TextureCoordinates, Other.TextureCoordinates);
    TextureCoordinates.resize(2 * After);
  }
  if (!Normals.empty() || !Other.Normals.empty()) {
    Normals.resize(3 * Before);
    Join(Normals, Other.Normals);
    Normals.resize(3 * After);
  }
  for (uint32_t &Corner : Other.Corners)
    Corner += FirstVertex;
  for (uint32_t &Look : Other.MaterialOf)
    Look += FirstLook;
  for (Material &M : Other.Materials)
    if (M.Picture)
      *M.Picture += FirstTexture;
  for (MeshPart &Part : Other.Parts)
    Part.First += triangles();
  Join(Parts, Other.Parts);
  Join(Positions, Other.Positions);
  Join(Colors, Other.Colors);
  Join(Corners, Other.Corners);
  Join(MaterialOf, Other.MaterialOf);
  Join(Materials, Other.Materials);
  std::ranges::move(Other.Textures, std::back_inserter(Textures));
  Join(Warnings, Other.Warnings);
}

void transform(Mesh &M, const Similarity &By) {
  if (By == Similarity())
    return;
  const auto Turn = [&By](std::vector<float> &Vectors, double Scale,
                          const std::array<double, 3> &Then) {
    for (std::size_t I = 0; I < Vectors.size(); I += 3) {
      const std::array<double, 3> V{Vectors[I], Vectors[I + 1], Vectors[I + 2]};
      for (std::size_t A = 0; A < 3; ++A) {
        double Sum = 0;
        for (std::size_t K = 0; K < 3; ++K)
          Sum += By.Rotation[A][K] * V[K];
        Vectors[I + A] = static_cast<float>(Scale * Sum + Then[A]);
      }
    }
  };
  Turn(M.Positions, By.Scale, By.Translation);
  Turn(M.Normals, 1, {});
}

void changeAxes(Mesh &M, const AxesChange &Change) {
  for (std::vector<float> *Vectors : {&M.Positions, &M.Normals})
    for (std::size_t I = 0; I < Vectors->size(); ++I)
      (*Vectors)[I] *=
          static_cast<float>(Change.From[I % 3] * Change.To[I % 3]);
}

std::shared_ptr<const Mesh> joined(std::shared_ptr<const Mesh> First,
                                   std::shared_ptr<const Mesh> Second,
                                   const WorldPoint &Origin) {
  if (!First)
    std::swap(First, Second);
  if (!First || (!Second && Origin == WorldPoint{}))
    return First;
  Mesh All = *First;
  if (Second)
    All.append(*Second);
  for (std::size_t I = 0; I < All.Positions.size(); ++I)
    All.Positions[I] = static_cast<float>(All.Positions[I] - Origin[I % 3]);
  return std::make_shared<const Mesh>(std::move(All));
}

bool isMeshFile(Bytes File) {
  if (isPlyFile(File))
    return asText(File).substr(0, 1 << 16).find("\nelement face ") !=
           std::string_view::npos;
  if (isGltf(File))
    return asText(File).find("gaussian_splat") == std::string_view::npos;
  return isText(File);
}

static Expected<Mesh> parse(const std::string &Path, Bytes File) {
  if (isPlyFile(File))
    return readPlyMesh(Path, File);
  if (isGltf(File))
    return readGltfMesh(Path, File);
  if (!isText(File))
    return Error{Path, "not a mesh, expected an OBJ, PLY or glTF file"};
  return readObjMesh(Path, File);
}

Expected<Mesh> readMesh(const std::string &Path) {
  const auto File = readFile(Path);
  if (!File)
    return File.error();
  if (File->empty())
    return Error{Path, "an empty file, expected a mesh"};
  auto Read = parse(Path, *File);
  if (!Read)
    return Read;
  // What a file ends with may have no triangles.
  while (Read->Parts.size() > 1 &&
         Read->Parts.back().First == Read->triangles())
    Read->Parts.pop_back();
  if (Read->triangles() == 0)
    return Error{Path, "no triangles, expected at least one"};
  if (Read->vertices() >= MaxMeshSize || Read->triangles() >= MaxMeshSize)
    return Error{Path,
                 fmt::format("{} vertices and {} triangles, expected less than "
                             "2^31 of each",
                             Read->vertices(), Read->triangles()),
                 ExitCode::LimitReached};
  for (MeshPart &Part : Read->Parts)
    Part.File = Path;
  return Read;
}

} // namespace vorion::splat
