/// glTF 2.0 with KHR_gaussian_splatting.
/// https://github.com/KhronosGroup/glTF/tree/main/extensions/2.0/Khronos/KHR_gaussian_splatting
#pragma once

#include "scene/SceneFile.h"

#include <functional>
#include <vector>

namespace vorion::splat {

/// Reads a file that buffers name, below the folder of the glTF file.
using GltfSource =
    std::function<Expected<std::vector<std::byte>>(const std::string &Name)>;

/// The scene of a `.glb` or the text of a `.gltf`: the primitives with
/// KHR_gaussian_splatting of all nodes of the default scene, each moved by its
/// nodes' transforms and joined in the nodes' order. Attributes are those of
/// the extension, or of its drafts (_ROTATION, _SCALE, COLOR_0); or the
/// primitive holds an `.spz`. Refused, by name: extensions that are required
/// and not known, other kernels, colour spaces and projections, compressed or
/// sparse accessors.
Expected<SceneFile> parseGltfFiles(const std::string &Where, Bytes File,
                                   const GltfSource &Read,
                                   const ReadOptions &Options);

/// Reads from the folder of the glTF file \p Path.
GltfSource filesBeside(const std::string &Path);

/// The same for the file \p Path, whose content is \p File; its buffers may be
/// files beside it.
Expected<SceneFile> readGltf(const std::string &Path, Bytes File,
                             const ReadOptions &Options);

} // namespace vorion::splat
