// Captures of other programs, which are refused by name.
#pragma once

#include "vorion/support/Expected.h"

#include <filesystem>
#include <optional>

namespace vorion::splat {

/// What \p Path, a folder or a file that is not a capture, is instead, and
/// which tool converts it; empty if it is unknown. Names of files decide, and
/// the start of tables and XML files.
std::optional<Error> foreignCapture(const std::filesystem::path &Path);

} // namespace vorion::splat
