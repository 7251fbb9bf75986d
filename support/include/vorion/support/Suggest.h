/// "Did you mean": what a mistyped word was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>

namespace vorion {

/// The word of \p Known that differs least from \p Word by letters left out,
/// put in, changed or swapped with their neighbour; empty if none is near. Of
/// several, the first.
std::string_view closestTo(std::string_view Word,
                           std::span<const std::string> Known);

} // namespace vorion
