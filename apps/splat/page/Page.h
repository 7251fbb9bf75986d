/// Self-contained HTML pages.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The chart library, with its licence.
std::string_view chartLibrary();

/// \p Template of EmbedPages.cmake, with @DATA@ and @LIBRARY@ replaced by \p
/// Data and \p Library.
std::string filledPage(std::string_view Template,
                       const nlohmann::ordered_json &Data,
                       std::string_view Library = chartLibrary());

/// A data URI of the \p Bytes of a PNG.
std::string pngUri(const std::string &Bytes);

} // namespace vorion::splat
