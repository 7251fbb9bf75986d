/// Variables of the environment that programs of ours read: errors of what they
/// say, and names that are nearly theirs.
#pragma once

#include "vorion/support/Expected.h"

#include <string_view>

namespace vorion::isasim {

/// Prints a warning of \p Tool for each variable that is set and that no
/// program reads, if its name is nearly that of one that is read.
void warnOfMisspeltVariables(std::string_view Tool);

/// Prints a warning of \p Tool, vorion-sim, for each variable that is set and
/// that OpenCL programs alone read.
void warnOfUnreadVariables(std::string_view Tool);

/// \p E, which says what is wrong with the text of the variable \p Name, with
/// that name before it.
Error inVariable(std::string_view Name, Error E);

/// \p E, which says what is wrong with a whole machine: with the names of the
/// variables that describe it, VORION_CONFIG and VORION_SET, where they do.
Error ofMachine(Error E, bool HasConfig, bool HasSet);

} // namespace vorion::isasim
