/// A scene that is open in `splat view`.
#pragma once

#include "scene/SceneFile.h"

#include <cstdint>
#include <string>

namespace vorion::splat {

struct ShownScene {
  std::string Name; ///< for people: of its file
  SceneFile File;
  uint64_t Number = 0; ///< from 1: of the scenes that were opened
};

} // namespace vorion::splat
