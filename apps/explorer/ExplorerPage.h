/// The page of vorion-explorer.
#pragma once

#include <string_view>

namespace vorion::splat {

/// explorer.html as page/EmbedPages.cmake embeds it.
std::string_view explorerTemplate();

} // namespace vorion::splat
