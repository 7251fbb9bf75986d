/// What the tools' main functions share.
#pragma once

#include "reference/Types.h"
#include "vorion/support/Diagnostics.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

namespace vorion::test {

/// Parses the command line of \p App, calls \p Run and gives the exit code;
/// errors are printed in the house form under the name of \p App.
int runTool(CLI::App &App, int Count, char **Values,
            const std::function<Expected<Success>()> &Run);

/// The support called \p Name on command lines; it must be one.
reference::Support supportNamed(const std::string &Name);

} // namespace vorion::test
