/// What files may call for that nothing here does. Ignoring it would draw
/// another picture than the file's, so readers refuse it by name.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// What a PLY's property \p Name would mean for the picture; nothing if it is
/// not known to mean anything ("nx", "label").
std::optional<std::string_view> unsupportedProperty(std::string_view Name);

/// What a camera record's key \p Key would mean with a value other than zero,
/// false or empty; nothing if it is not known to mean anything.
std::optional<std::string_view> unsupportedCameraKey(std::string_view Key);

} // namespace vorion::splat
