/// Text from files, as a terminal may get it.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text on one line, without anything that a terminal obeys: control
/// characters, marks that turn the direction of text, and bytes that are no
/// UTF-8 become \xNN, byte by byte. Other letters stay as they are.
std::string escaped(std::string_view Text);

/// The same, but with the line ends of \p Text.
std::string escapedLines(std::string_view Text);

/// How many columns of a terminal \p Text takes, in which there is nothing that
/// it obeys: letters of Chinese or Japanese take two, and accents that stand
/// behind their letter none.
std::size_t columns(std::string_view Text);

/// As much of the beginning of such a text as \p Most columns hold.
std::string_view firstColumns(std::string_view Text, std::size_t Most);

/// As escaped(), the first \p Most bytes, with "..." if there are more: a
/// damaged file may hold a name of any length.
std::string printable(std::string_view Text, std::size_t Most = 80);

} // namespace vorion
