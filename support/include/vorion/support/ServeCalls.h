/// A tool as a server process, which avoids its start-up time.
#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace vorion {

/// What a server gives for a request.
struct Response {
  std::string Text;
  /// Whether the process may serve another request.
  bool MayStay = true;
};

/// What the process printed on standard error since the last call of this
/// function: that is a file in memory while serveCalls() runs.
std::string takePrinted();

/// Serves requests over standard input, a socket (ToolMessages.h), in a daemon
/// process: the original process exits at once, so that its parent need not
/// wait. The daemon exits when its client disconnects, whatever it is doing,
/// after ten seconds without a request, after a response that says so, and when
/// its memory has grown much, because clang does not free memory. If it ends
/// before it gave a response, for whatever reason, a second process sends a
/// ServerEnd to standard output, a socket as well. Returns the exit code.
int serveCalls(const std::function<Response(std::string_view)> &Answer);

} // namespace vorion
