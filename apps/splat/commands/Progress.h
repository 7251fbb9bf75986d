/// What a person at a terminal sees while a device works.
#pragma once

#include <functional>
#include <string_view>

namespace vorion::splat {

/// A line on a terminal that says what is going on; nothing elsewhere.
std::function<void(std::string_view)> progress();

/// Clears that line.
void endProgress();

} // namespace vorion::splat
