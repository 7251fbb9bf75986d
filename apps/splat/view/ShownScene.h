/// A scene that is open in `splat view`.
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
  std::string Name; ///< for people: of its file
  /// Where `splat render` finds it, and the options with which it reads it.
  std::string Path;
  std::vector<std::string> Words;
  SceneFile File;
  Vector Up{};         ///< of the scene, a unit vector
  uint64_t Number = 0; ///< from 1: of the scenes that were opened
};

} // namespace vorion::splat
