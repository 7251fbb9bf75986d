/// Line wrapping of --help.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text with lines wrapped at \p Columns columns. Continuation lines are
/// indented to the last column of the line, as for descriptions of options; if
/// little space is left, a description starts on a new line.
std::string wrapped(std::string_view Text, std::size_t Columns);

/// Writes \p Text to standard output, wrapped to the variable COLUMNS, else to
/// the terminal's width; unwrapped if there is no terminal.
void printHelp(std::string_view Text);

} // namespace vorion
