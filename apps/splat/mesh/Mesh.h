/// A mesh of triangles beside a scene's Gaussians, and the files that have one.
#pragma once

#include "io/Bytes.h"
#include "io/LocalFrame.h"
#include "mesh/Texture.h"
#include "scene/Axes.h"
#include "scene/Edit.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// What the alpha of a surface means.
enum class AlphaMode {
  Opaque, ///< nothing
  Mask,   ///< nothing is drawn where it is below the cut-off
  Blend   ///< how much of what is behind the surface it hides
};

/// How the triangles of a material look. Its base colour is in the colours of
/// the vertices.
struct Material {
  std::optional<uint32_t> Picture; ///< of Mesh::Textures
  Sampler Sampling;
  AlphaMode Alpha = AlphaMode::Opaque;
  float Cutoff = 0.5F; ///< with AlphaMode::Mask
};

/// What a reader could not follow, and draws otherwise.
struct MeshWarning {
  std::string Where, What; ///< as of an Error
};

/// Triangles that a file has one after the other.
struct MeshPart {
  std::string File; ///< where they were read, empty if nowhere
  /// Of the glTF node or the OBJ's object, printable; may be empty.
  std::string Name;
  std::size_t First = 0;  ///< the first of them in the mesh
  std::size_t Number = 0; ///< and in the file, from 0
};

/// A corner of a polygon.
struct MeshCorner {
  uint32_t Vertex = 0;
  std::array<float, 2> TextureCoordinate{};
  std::array<float, 3> Normal{};
};

/// Vertices in the world's units, with colours as pictures show them.
struct Mesh {
  std::vector<MeshPart> Parts{1}; ///< the first begins at triangle 0
  std::vector<float> Positions;   ///< x, y, z of each vertex, finite
  std::vector<float> Colors;      ///< red, green, blue, alpha of each, 0 to 1
  std::vector<uint32_t> Corners;  ///< three vertices of each triangle
  /// Across and down the picture, 0 to 1 in it, for each corner; empty if no
  /// triangle has a texture.
  std::vector<float> TextureCoordinates;
  /// x, y, z for each corner, of any length, 0 where the file has none; empty
  /// if it has none at all.
  std::vector<float> Normals;
  std::vector<Material> Materials;
  std::vector<uint32_t> MaterialOf; ///< of each triangle
  std::vector<Texture> Textures;
  std::vector<MeshWarning> Warnings;

  std::size_t vertices() const { return Positions.size() / 3; }
  std::size_t triangles() const { return Corners.size() / 3; }
  bool hasTextures() const { return !TextureCoordinates.empty(); }
  /// Whether a triangle's alpha is \p Mode.
  bool has(AlphaMode Mode) const;
  /// Where \p Triangle is from.
  const MeshPart &partOf(std::size_t Triangle) const;
  /// Where the first triangle was read.
  const std::string &file() const { return Parts.front().File; }

  /// Appends a vertex and returns its number.
  uint32_t addVertex(const std::array<float, 3> &Position,
                     const std::array<float, 4> &Color);
  /// Appends a polygon as a fan of triangles about its first corner, which look
  /// like Materials[Look].
  void addPolygon(std::span<const MeshCorner> Polygon, uint32_t Look);
  /// The triangles that are added next are of the node or object \p Name.
  void beginPart(std::string_view Name);
  /// Appends the triangles of \p Other, which keep their order.
  void append(Mesh Other);
};

/// \name Other places of vertices, and normals that follow
/// Computed in double and rounded once.
/// @{
void transform(Mesh &M, const Similarity &By);
void changeAxes(Mesh &M, const AxesChange &Change);
/// @}

/// The triangles of \p First, then those of \p Second, in the frame with the
/// origin \p Origin. Both may be null; then the result is.
std::shared_ptr<const Mesh> joined(std::shared_ptr<const Mesh> First,
                                   std::shared_ptr<const Mesh> Second,
                                   const WorldPoint &Origin);

/// Vertices and triangles that a mesh may have: numbers of both have 31 bits.
inline constexpr std::size_t MaxMeshSize = std::size_t{1} << 31;

/// The mesh of an OBJ, PLY or glTF file (docs/meshes.md), which the content
/// decides. Error: one line with the file and the place.
Expected<Mesh> readMesh(const std::string &Path);

/// \name The triangles of one format; \p Where is the file's path
/// @{
Expected<Mesh> readObjMesh(const std::string &Where, Bytes File);
Expected<Mesh> readPlyMesh(const std::string &Where, Bytes File);
Expected<Mesh> readGltfMesh(const std::string &Where, Bytes File);
/// @}

class GltfWriter;
/// Adds \p M to a `.glb`, a primitive for each material. Colours become linear;
/// textures are the files that were read.
void addMesh(GltfWriter &To, const Mesh &M);

/// Whether \p File may be a mesh rather than a scene of Gaussians: an OBJ, a
/// PLY with faces, or a glTF file without KHR_gaussian_splatting.
bool isMeshFile(Bytes File);

} // namespace vorion::splat
