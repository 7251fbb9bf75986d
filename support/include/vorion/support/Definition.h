/// The definition of a command line, for programs: pages of the manual,
/// completion in shells and the documents' lists are made of it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace vorion {

/// What \p App takes, as JSON (docs/schemas/vorion-command-line.json).
std::string definitionOf(const CLI::App &App);

} // namespace vorion
