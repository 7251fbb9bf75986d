/// An open scene of `splat view`.
#pragma once

#include "cameras/Vector.h"
#include "io/Cameras.h"
#include "scene/SceneFile.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The largest file that a page may send, in bytes.
inline constexpr std::size_t LargestScene = std::size_t{1} << 30;

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
};

/// Writes the Gaussians of \p S in the frame of its file, in the format of the
/// extension of \p Path, or as INRIA's PLY.
Expected<Success> writeShown(const std::string &Path, const ShownScene &S);

} // namespace vorion::splat
