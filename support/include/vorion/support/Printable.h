/// Text from files, as a terminal may get it.
#pragma once

#include <string>
#include <string_view>

namespace vorion {

/// \p Text on one line, without anything that a terminal obeys: control
/// characters, marks that turn the direction of text, and bytes that are no
/// UTF-8 become \xNN, byte by byte. Other letters stay as they are.
std::string escaped(std::string_view Text);

/// The same, but with the line ends of \p Text.
std::string escapedLines(std::string_view Text);

/// As escaped(), the first \p Most bytes, with "..." if there are more: a
/// damaged file may hold a name of any length.
std::string printable(std::string_view Text, std::size_t Most = 80);

} // namespace vorion
