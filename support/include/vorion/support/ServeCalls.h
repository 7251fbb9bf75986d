/// A tool that stays, so that its start is paid for once.
#pragma once

#include <functional>
#include <span>

namespace vorion {

/// Serves calls over standard input, a socket (ToolMessages.h), in a process
/// that is nobody's child: the one that was started ends at once, so that its
/// parent has none to wait for. \p Call gets what a main function gets, \p Name
/// first, and gives the exit code; the answer is that number, a blank, and what
/// was printed. The process ends when its client is gone, after ten seconds
/// without a call, after a call that failed, and when calls have left much
/// memory taken: clang gives none back. Returns the exit code.
int serveCalls(char *Name, const std::function<int(std::span<char *>)> &Call);

} // namespace vorion
