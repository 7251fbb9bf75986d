/// The progress line of a terminal, which is overwritten until something else
/// is printed. There is one per process, on standard error; none if the
/// terminal cannot overwrite lines (Terminal.h).
#pragma once

#include <string_view>

namespace vorion {

/// Replaces the line by \p Text, truncated to the current width of the
/// terminal. An interrupt that stops the tool terminates the line first
/// (Tool.h).
void showStatus(std::string_view Text);

/// Removes the line, so that something else can be printed there.
void clearStatus();

/// Keeps the line and starts a new one. Async-signal-safe.
void keepStatus();

} // namespace vorion
