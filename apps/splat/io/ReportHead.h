/// The head of every report of splat: its schema (docs/schemas) and provenance,
/// with which `splat replay` reproduces it.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Sets the command line of this process without the program's name; called
/// once by its main function.
void setCommandLine(std::vector<std::string> Arguments);
/// Adds an option that was not given, with its default, so that a report has
/// all options to reproduce the result.
void completeCommandLine(std::string Option, std::string Value);

/// "schema" with \p Name and \p Version, and "program" with its versions, its
/// command line, and the folder and environment variables on which it depends.
/// docs/schemas/README.md says when a version changes.
nlohmann::ordered_json reportHead(std::string_view Name, unsigned Version = 1);

/// The command line and its program in one line, for the footer of a page.
std::string madeBy();

/// Whether the environment's variable \p Name can change a result.
bool isRecordedVariable(std::string_view Name);

} // namespace vorion::splat
