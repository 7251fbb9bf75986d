/// Variables of the environment whose names are nearly those that programs of
/// ours read.
#pragma once

#include <string_view>

namespace vorion::isasim {

/// Prints a warning of \p Tool for each variable that is set and that no
/// program reads, if its name is nearly that of one that is read.
void warnOfMisspeltVariables(std::string_view Tool);

} // namespace vorion::isasim
