/// The line of a terminal that says what is going on, and is written over until
/// something else is printed. There is one, on standard error; where a line
/// cannot be overwritten (Terminal.h) there is none.
#pragma once

#include <string_view>

namespace vorion {

/// Puts \p Text in the place of what the line shows: as much of it as fits into
/// the terminal, whose width is asked for each time. An interrupt that ends a
/// tool meanwhile ends the line first (Tool.h).
void showStatus(std::string_view Text);

/// Removes the line, so that something else can be printed there.
void clearStatus();

/// Leaves what the line shows, and goes on below it. May be called in a
/// signal's handler.
void keepStatus();

} // namespace vorion
