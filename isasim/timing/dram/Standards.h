/// The texts of standards/, made part of the program by EmbedJson.cmake.
#pragma once

#include <string_view>

namespace vorion::isasim::dram {

/// The table of that name as JSON, empty if there is none.
std::string_view standardText(std::string_view Name);

} // namespace vorion::isasim::dram
