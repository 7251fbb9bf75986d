/// The command lines of the tools that use CLI11.
#pragma once

#include "vorion/support/Expected.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion {

/// Parses \p Arguments, without the program's name, by \p App, whose name is
/// the tool's. The exit code if that was all, for help and for what the parser
/// refuses: that is said in the house form, with what was probably meant.
std::optional<int> parseCommandLine(CLI::App &App,
                                    std::vector<std::string> Arguments);

/// The same for options that come from elsewhere than a command line: prints
/// nothing. \p App has no help.
Expected<Success> parseOptions(CLI::App &App,
                               std::vector<std::string> Arguments);

} // namespace vorion
