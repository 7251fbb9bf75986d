/// SOG in folders: one data set, chunks side by side, or a streamed scene.
/// https://developer.playcanvas.com/user-manual/gaussian-splatting/formats/streamed-sog
#pragma once

#include "scene/formats/Sog.h"

namespace vorion::splat {

/// Reads a folder that has `lod-meta.json` (a streamed scene), `meta.json` (one
/// data set), or sub-folders with `meta.json` (chunks of one level of detail,
/// joined in the order of their names).
Expected<SceneFile> readSogFolder(const std::string &Path,
                                  const ReadOptions &Options);

/// Whether \p File is SOG's `meta.json` or `lod-meta.json`. Those of
/// splat-transform have the key `asset`, as glTF has.
bool isSogJson(Bytes File);

/// Reads the folder around \p Path, a `meta.json` or `lod-meta.json` whose
/// content is \p File.
Expected<SceneFile> readSogJson(const std::string &Path, Bytes File,
                                const ReadOptions &Options);

/// Decodes what \p Index, the content of lod-meta.json, lists for one level of
/// detail, and the environment if there is one. The ranges of Gaussians of all
/// leaves of the tree must be disjoint and inside their chunks.
Expected<SceneFile> parseStreamedSog(const std::string &Where, Bytes Index,
                                     const FileSource &Read,
                                     const ReadOptions &Options);

} // namespace vorion::splat
