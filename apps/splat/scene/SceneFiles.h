/// Which files a scene is read from.
#pragma once

#include <string>
#include <vector>

namespace vorion::splat {

/// The files at \p Path that readScene() reads, or would for another level of
/// detail: the file itself, and those that descriptions (of SOG in a folder, or
/// a .gltf) name and that are there. Damaged descriptions name none.
std::vector<std::string> sceneFiles(const std::string &Path);

} // namespace vorion::splat
