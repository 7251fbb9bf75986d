/// What shows that a file has changed, without reading it.
#pragma once

#include <filesystem>
#include <string>

namespace vorion {

/// Size and time of the last change of \p File, with a blank between. No file
/// has the state that is given for a missing one.
std::string stateOf(const std::filesystem::path &File);

} // namespace vorion
