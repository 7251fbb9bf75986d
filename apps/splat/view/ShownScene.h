/// An open scene of `splat view`.
#pragma once

#include "cameras/Vector.h"
#include "scene/SceneFile.h"

#include <cstddef>
#include <cstdint>
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
  SceneFile File;
  Vector Up{};         ///< up direction, a unit vector
  uint64_t Number = 0; ///< counts opened scenes from 1
};

} // namespace vorion::splat
