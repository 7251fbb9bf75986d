/// Escaping of text from files for terminals.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text on one line, safe for terminals: control characters, bidirectional
/// formatting characters and invalid UTF-8 become \xNN, byte by byte. Other
/// characters are unchanged.
std::string escaped(std::string_view Text);

/// The same, but line ends are preserved.
std::string escapedLines(std::string_view Text);

/// Width of the escaped \p Text in terminal columns: East Asian wide characters
/// take two, combining characters none.
std::size_t columns(std::string_view Text);

/// The longest prefix of such a text that fits into \p Most columns.
std::string_view firstColumns(std::string_view Text, std::size_t Most);

/// As escaped(), truncated to \p Most bytes with "...": a damaged file may have
/// a name of any length.
std::string printable(std::string_view Text, std::size_t Most = 80);

} // namespace vorion
