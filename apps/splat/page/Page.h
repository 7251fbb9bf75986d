/// Pages of HTML: each one file that needs no other and no network.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The library that draws charts, with its licence.
std::string_view chartLibrary();

/// \p Template, which EmbedPages.cmake made, with \p Data and the library where
/// it says @DATA@ and @LIBRARY@.
std::string filledPage(std::string_view Template,
                       const nlohmann::ordered_json &Data);

/// The \p Bytes of a PNG, as a page names them.
std::string pngUri(const std::string &Bytes);

} // namespace vorion::splat
