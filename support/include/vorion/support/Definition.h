/// The machine-readable definition of a command line, from which manual pages,
/// shell completion and the documents' lists of options are generated.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vorion {

/// The definition of \p App as JSON (docs/schemas/vorion-command-line.json).
std::string definitionOf(const CLI::App &App);

} // namespace vorion
