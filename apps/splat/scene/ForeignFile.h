/// Files that are no scenes: what each is (FileKind.h), and how its owner may
/// come to a scene.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// Of \p File, which no format of Formats.def takes for its own: why it is no
/// scene; nothing if it may be a `.splat`, which has no mark. Any text is known
/// to be none.
std::optional<Error> foreignFile(const std::string &Where, Bytes File);

/// The same for a zip archive of \p Names that is no SOG.
Error foreignArchive(const std::string &Where,
                     const std::vector<std::string> &Names);

/// The same for what is written in JSON and describes no scene.
Error foreignJson(const std::string &Where, const nlohmann::json &Root);

/// The same for a file of which nothing is known.
Error unknownFile(const std::string &Where);

} // namespace vorion::splat
