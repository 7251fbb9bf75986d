#include "vorion/support/Tool.h"

#include "vorion/support/Diagnostics.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <fmt/format.h>
#include <new>
#include <unistd.h>

namespace vorion {
namespace {

/// A file that is opened while a standard stream is closed would take its
/// number, and get what is printed. What cannot be written stays an error.
void keepStandardStreams() {
  for (const int Stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    if (::fcntl(Stream, F_GETFD) < 0 && errno == EBADF)
      static_cast<void>(::open("/dev/null", O_RDONLY));
}

int reportFullOutput(std::string_view Tool, int Cause) {
  return reportError(
      Tool, {"standard output",
             fmt::format("cannot write: {}, expected one that "
                         "takes what is printed",
                         Cause ? std::strerror(Cause) : "not all was taken")});
}

/// Without taking memory, of which there may be none.
int reportNoMemory(std::string_view Tool) {
  for (const std::string_view Part :
       {Tool, std::string_view(": error: memory ran out, expected a smaller "
                               "input or a machine with more\n")})
    if (::write(STDERR_FILENO, Part.data(), Part.size()) < 0)
      break;
  return static_cast<int>(ExitCode::LimitReached);
}

} // namespace

int runTool(std::string_view Tool, const std::function<int()> &Body) {
  keepStandardStreams();
  int Code = 0;
  try {
    Code = Body();
    errno = 0;
    const bool Flushed = std::fflush(stdout) == 0;
    if ((!Flushed || std::ferror(stdout)) && Code == 0)
      Code = reportFullOutput(Tool, errno);
  } catch (const std::bad_alloc &) {
    Code = reportNoMemory(Tool);
  } catch (const std::exception &E) {
    Code = std::ferror(stdout)
               ? reportFullOutput(Tool, errno)
               : reportError(Tool, {"",
                                    fmt::format("a bug: {}, expected no "
                                                "exception",
                                                E.what()),
                                    ExitCode::Internal});
  }
  return Code;
}

} // namespace vorion
