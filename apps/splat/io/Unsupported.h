/// Unsupported features of files. Ignoring them would render a wrong picture,
/// so readers reject them by name.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The feature that a PLY's property \p Name stands for; empty if it does not
/// affect the picture ("nx", "label").
std::optional<std::string_view> unsupportedProperty(std::string_view Name);

/// The key of \p Record, a camera, that requires an unsupported feature, and
/// the feature; keys whose value is zero, false or empty are ignored.
std::optional<std::string> unsupportedIn(const nlohmann::json &Record);

} // namespace vorion::splat
