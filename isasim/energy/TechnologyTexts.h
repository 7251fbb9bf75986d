/// The files of technologies/, which EmbedJson.cmake makes part of the program.
#pragma once

#include <span>
#include <string_view>

namespace vorion::isasim {

/// The default comes first.
std::span<const std::string_view> technologyNames();
/// The file of that name as JSON, empty if there is none.
std::string_view technologyText(std::string_view Name);

} // namespace vorion::isasim
