/// The readers of the formats in Formats.def that are one file: for each ID
/// - isID: whether a file's content is of the format, by a mark at its start.
/// No
///   content is of two formats. Splat has no mark: what nothing else is;
/// - parseID: the scene that the file \p Where holds. Its values need not be
///   finite, and it may be empty: parseScene() looks. An Error of \p Where says
///   what is wrong and what was expected. Memory follows the file's size or
///   what it says that it holds, whichever is less.
/// What a format keeps and what is refused is in its source file.
#pragma once

#include "scene/SceneFile.h"

namespace vorion::splat {

#define SCENE_FORMAT(ID, NAME, AXES, ENDING, TITLE)                            \
  bool is##ID(Bytes File);                                                     \
  Expected<SceneFile> parse##ID(const std::string &Where, Bytes File,          \
                                const ReadOptions &Options);
#include "scene/formats/Formats.def"

} // namespace vorion::splat
