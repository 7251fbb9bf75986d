/// What files may call for that nothing here does. Ignoring it would draw
/// another picture than the file's, so readers refuse it by name.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// What a PLY's property \p Name would mean for the picture; nothing if it is
/// not known to mean anything ("nx", "label").
std::optional<std::string_view> unsupportedProperty(std::string_view Name);

/// Which key of \p Record, a camera's, calls for what nothing here does, and
/// what that is; keys whose value is zero, false or empty call for nothing.
std::optional<std::string> unsupportedIn(const nlohmann::json &Record);

} // namespace vorion::splat
