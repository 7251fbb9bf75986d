/// A tool as a server process, which avoids its start-up time.
#pragma once

#include <functional>
#include <span>

namespace vorion {

/// Serves calls over standard input, a socket (ToolMessages.h), in a daemon
/// process: the original process exits at once, so that its parent need not
/// wait. \p Call has the arguments of a main function, with \p Name first, and
/// returns the exit code; the response is that number, a blank, and the printed
/// text. The process exits when its client disconnects, after ten seconds
/// without a call, after a failed call, and when its memory has grown much,
/// because clang does not free memory. Returns the exit code.
int serveCalls(char *Name, const std::function<int(std::span<char *>)> &Call);

} // namespace vorion
