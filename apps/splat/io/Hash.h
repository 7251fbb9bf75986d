/// Hashes of scenes.
#pragma once

#include "vorion/support/Expected.h"
#include "vorion/support/Hash.h"

#include <string>

namespace vorion::splat {

/// fnv1a64() of a scene: of the file, or of the names and contents of all files
/// in a folder, in the order of their names; a .json file represents its
/// folder.
Expected<std::string> hashScene(const std::string &Path);

} // namespace vorion::splat
