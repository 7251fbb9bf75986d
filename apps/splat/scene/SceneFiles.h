/// The files of a scene.
#pragma once

#include <string>
#include <vector>

namespace vorion::splat {

/// The files that readScene() reads for \p Path at any level of detail: the
/// file itself, and the existing files to which descriptions (of SOG in a
/// folder, or a .gltf) refer. Damaged descriptions refer to none.
std::vector<std::string> sceneFiles(const std::string &Path);

} // namespace vorion::splat
