/// What terminals can show.
#pragma once

#include <cstddef>
#include <optional>
#include <string>

namespace vorion {

/// Whether standard error is a terminal that clears and overwrites a line: not
/// if TERM is dumb or missing.
bool canOverwrite();

/// Whether it shows colours, and nobody asked for none (https://no-color.org).
bool canColour();

/// The columns of the terminal \p File, a descriptor; nothing for what is none
/// or does not say. A window's size changes: ask each time.
std::optional<std::size_t> columnsOf(int File);

/// A bar of fixed width of which the share \p Done of \p All is full:
/// "[====      ]".
std::string barText(std::size_t Done, std::size_t All);

/// A time that is left, as people say it: "40 s", "3 min", "2 h 5 min".
std::string durationText(double Seconds);

/// What follows a count in a line of progress: ", 3 min left" at the rate of
/// the \p Done of \p All that took \p Seconds; nothing before the first and
/// after the last.
std::string timeLeftText(double Seconds, std::size_t Done, std::size_t All);

} // namespace vorion
