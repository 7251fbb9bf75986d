/// The texts of configs/, made part of the program by EmbedJson.cmake.
#pragma once

#include <string_view>

namespace vorion::isasim {

/// The configuration of that name as JSON, empty if there is none.
std::string_view machineText(std::string_view Name);

} // namespace vorion::isasim
