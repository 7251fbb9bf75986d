/// Triangles beside Gaussians: where they are seen, and how they look.
#pragma once

#include "Render.h"
#include "reference/Types.h"

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <optional>
#include <vector>

namespace vorion::reference {

/// A picture on triangles.
struct Texture {
  struct Level {
    int Width = 0, Height = 0;
    std::vector<glm::dvec4> Texels; ///< as stored, 0 to 1; rows from the top
  };
  std::vector<Level> Levels; ///< the first is the largest
};

/// How the triangles of a material look.
struct MeshLook {
  enum class Edge { Repeat, Mirror, Clamp };
  enum class Mips { None, Nearest, Linear };
  int Picture = -1; ///< of Mesh::Textures
  std::array<Edge, 2> Edges{};
  bool MagnifiesLinearly = true, MinifiesLinearly = true;
  Mips Levels = Mips::Linear;
  double Cutoff = 0; ///< nothing is seen where alpha is less
  bool IsTransparent = false;
};

/// Triangles, in the world.
struct Mesh {
  std::vector<glm::dvec3> Positions;
  std::vector<glm::dvec4> Colors;      ///< of positions, as pictures show them
  std::vector<uint32_t> Corners;       ///< three of each triangle
  std::vector<glm::dvec2> Coordinates; ///< of corners; may be empty
  std::vector<glm::dvec3> Normals;     ///< of corners; 0: the triangle's own
  std::vector<MeshLook> Looks;
  std::vector<uint32_t> LookOf; ///< of triangles
  std::vector<Texture> Textures;
  /// The direction in which a light shines, of length 1.
  std::optional<glm::dvec3> Light;

  std::size_t triangles() const { return Corners.size() / 3; }
};

/// The colour and alpha of a triangle at a place of the picture.
struct MeshColor {
  glm::dvec4 Rgba{0};
  /// Whether an implementation in fp32 may take another texel or level.
  bool Doubtful = false;
};

/// The colour of triangle \p T of \p M where the ray through \p Place (px)
/// meets its plane, held within the triangle. \p C is a pinhole or has parallel
/// rays.
MeshColor colorOf(const Mesh &M, const Camera<double> &C, std::size_t T,
                  glm::dvec2 Place);

/// A transparent triangle in a pixel.
struct SeenLayer {
  double Depth;
  int64_t Triangle;
  double Slack = 0; ///< as in MeshView
};

/// Which triangle each pixel sees, rows from the top.
struct MeshView {
  std::vector<double> Depths;     ///< along the camera's axis; infinite: none
  std::vector<int64_t> Triangles; ///< -1: none
  /// By how much a machine's depth may differ, which rounds corners to 1/256
  /// pixel and depths to fp32.
  std::vector<double> Slack;
  /// Pixels in which such a machine may see another triangle: those within half
  /// a sub-pixel of an edge of a triangle that is not hidden, and ties of
  /// depths.
  std::vector<bool> Doubtful;
  /// Transparent triangles in front of these, the nearest first; may be empty.
  std::vector<std::vector<SeenLayer>> Layers;
};

/// The nearest triangles of \p M beyond the near plane of \p O, wholly in fp64.
MeshView viewOf(const Mesh &M, const Camera<double> &C, const Options &O);

/// What \p Seen is for blend().
Surface<double> surfaceOf(const Mesh &M, const Camera<double> &C,
                          const MeshView &Seen);

} // namespace vorion::reference
