/// What --help prints, on terminals of any width.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace vorion {

/// \p Text with its long lines broken between words, so that none has more than
/// \p Columns columns. What a line breaks off goes on below its last column, as
/// the descriptions of options do; where that leaves little room, a description
/// goes below the option.
std::string wrapped(std::string_view Text, std::size_t Columns);

/// Writes \p Text to standard output, as wide as the variable COLUMNS says,
/// else as the terminal is; elsewhere as it is.
void printHelp(std::string_view Text);

} // namespace vorion
