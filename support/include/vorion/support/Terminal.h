/// What standard error can show.
#pragma once

namespace vorion {

/// Whether it is a terminal that clears and overwrites a line: not if TERM is
/// dumb or missing.
bool canOverwrite();

/// Whether it shows colours, and nobody asked for none (https://no-color.org).
bool canColour();

} // namespace vorion
