/// An open scene of `splat view`.
#pragma once

#include "io/Cameras.h"
#include "io/Vector.h"
#include "mesh/Mesh.h"
#include "scene/SceneFile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The largest file that a page may send, in bytes.
inline constexpr std::size_t LargestScene = std::size_t{1} << 30;

/// A file with a mesh that is shown beside scenes.
struct ShownMesh {
  std::string Name; ///< of the file, for the command line
  std::string Path;
  bool IsTemporary = false;                        ///< as of a ShownScene
  std::shared_ptr<const Mesh> Triangles = nullptr; ///< in the world
};

struct ShownScene {
  std::string Name; ///< name of its file, for display
  /// The path and the reading options for `splat render`.
  std::string Path;
  std::vector<std::string> Words;
  /// Whether that file is, or will be when it is needed, in a folder of this
  /// process.
  bool IsTemporary = false;
  SceneFile File;
  Vector Up{};         ///< up direction, a unit vector
  uint64_t Number = 0; ///< counts opened scenes from 1
  /// The automatic view of a scene that a page sent, which has no cameras.
  std::optional<Camera> Found = std::nullopt;
  /// Depth of the near plane, if it is not that of the rules (SceneUnit.h).
  std::optional<float> Near = std::nullopt;
  unsigned Edits = 0; ///< number of edits since it was opened

  /// \name Triangles; null: none
  /// @{
  /// Of its file, in the world, in the axes of its Gaussians.
  std::shared_ptr<const Mesh> OwnMesh = nullptr;
  ShownMesh AddedMesh = {}; ///< of another file
  /// All of them, in the frame of the Gaussians, by joinMeshes().
  std::shared_ptr<const Mesh> Surface = nullptr;
  /// The direction in which a light shines on them, of length 1.
  std::optional<std::array<float, 3>> Light = std::nullopt;
  /// @}
};

/// Sets \c Surface of \p S.
void joinMeshes(ShownScene &S);

/// Writes \p S in the frame of its file, in the format of the extension of \p
/// Path, or as INRIA's PLY: the Gaussians, and in a `.glb` the mesh of its
/// file.
Expected<Success> writeShown(const std::string &Path, const ShownScene &S);

} // namespace vorion::splat
