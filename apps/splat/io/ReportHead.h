/// How every report of splat begins: its schema (docs/schemas), and what made
/// it, so that `splat replay` can make it again.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// The command line of this process without the program's name, said once by
/// its main function.
void setCommandLine(std::vector<std::string> Arguments);
/// Adds an option that the user left out, with the value that it then has: a
/// result is made again by what reports say.
void completeCommandLine(std::string Option, std::string Value);

/// "schema" with \p Name and \p Version, and "program" with its versions, its
/// command line, and the folder and variables that give it a meaning.
/// docs/schemas/README.md says when a version changes.
nlohmann::ordered_json reportHead(std::string_view Name, unsigned Version = 1);

/// The command line and its program in a line, for the foot of a page.
std::string madeBy();

/// Whether the environment's variable \p Name can change a result.
bool isRecordedVariable(std::string_view Name);

} // namespace vorion::splat
