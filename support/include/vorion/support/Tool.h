/// What every main function does around its work.
#pragma once

#include <functional>
#include <string_view>

namespace vorion {

/// Calls \p Body and gives the exit code that it says. What it throws, and
/// standard output that does not take what was printed, end in one line under
/// the name of \p Tool: memory that ran out, in whatever thread, as a
/// limit, anything else as a bug of ours. From here on a limit of the size of
/// files (ulimit -f) is an error of whatever writes, and one of processor time
/// (ulimit -t) ends in one line; and catchEndingSignals() has been called.
int runTool(std::string_view Tool, const std::function<int()> &Body);

/// From here on SIGHUP, SIGINT, SIGPIPE, SIGQUIT and SIGTERM leave a whole
/// status line and no temporary file behind (RemovedAtEnd.h) when they end the
/// process. One that does not have its default action keeps the one that it
/// has. For who has set one back to the default.
void catchEndingSignals();

} // namespace vorion
