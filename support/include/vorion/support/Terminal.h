/// Capabilities of terminals.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace vorion {

/// Whether standard error is a terminal that clears and overwrites a line: not
/// if TERM is dumb or missing.
bool canOverwrite();

/// Whether it shows colours, and NO_COLOR is not set (https://no-color.org).
bool canColour();

/// The width of the terminal \p File, a descriptor, in columns; empty if it is
/// not a terminal or the width is unknown. Do not cache it, because windows are
/// resized.
std::optional<std::size_t> columnsOf(int File);

/// A progress bar of fixed width, filled by \p Done / \p All: "[==== ]".
std::string barText(std::size_t Done, std::size_t All);

/// A remaining time in human-readable form: "40 s", "3 min", "2 h 5 min".
std::string durationText(double Seconds);

/// What follows a count in a line of progress: ", 3 min left" at the rate of
/// the \p Done of \p All that took \p Seconds; nothing before the first and
/// after the last.
std::string timeLeftText(double Seconds, std::size_t Done, std::size_t All);

} // namespace vorion
