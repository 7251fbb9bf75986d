/// Environment variables of our programs: errors in their values, and misspelt
/// names.
#pragma once

#include "vorion/support/Expected.h"

#include <string_view>

namespace vorion::isasim {

/// Prints a warning of \p Tool for each environment variable that no program
/// reads and whose name is similar to a known one.
void warnOfMisspeltVariables(std::string_view Tool);

/// Prints a warning of \p Tool, vorion-sim, for each environment variable that
/// only OpenCL programs read.
void warnOfUnreadVariables(std::string_view Tool);

/// Prepends the name of the variable \p Name to \p E, an error in its value.
Error inVariable(std::string_view Name, Error E);

/// Adds the names of the variables VORION_CONFIG and VORION_SET, as far as they
/// are set, to \p E, an error in the configuration of the machine.
Error ofMachine(Error E, bool HasConfig, bool HasSet);

} // namespace vorion::isasim
