/// Errors for files that are not scenes: their kind (FileKind.h), and a hint
/// how to get a scene.
#pragma once

#include "io/Bytes.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The error for \p File, which no format of Formats.def recognizes; empty if
/// it may be a `.splat`, which has no magic bytes. Text is never a `.splat`.
std::optional<Error> foreignFile(const std::string &Where, Bytes File);

/// The same for a zip archive of \p Names that is not a SOG.
Error foreignArchive(const std::string &Where,
                     const std::vector<std::string> &Names);

/// The same for JSON that does not describe a scene.
Error foreignJson(const std::string &Where, const nlohmann::json &Root);

/// The same for a file of unknown kind.
Error unknownFile(const std::string &Where);

} // namespace vorion::splat
