/// How the texts of configs/, which EmbedJson.cmake makes part of the program,
/// become machines.
#pragma once

#include "vorion/isasim/Config.h"

#include <string>
#include <string_view>

namespace vorion::isasim {

/// The configuration of that name as JSON, empty if there is none.
std::string_view machineText(std::string_view Name);

/// Where a configuration is from that stood on a command line or in a variable
/// itself; no file is named so.
inline constexpr std::string_view GivenText = "configuration";

/// Sets what the keys of a JSON text say, as parseConfig() does, and checks
/// each value but not the whole.
Expected<Success> changeConfig(Config &C, std::string_view Text,
                               const std::string &Where);

} // namespace vorion::isasim
