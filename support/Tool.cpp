#include "vorion/support/Tool.h"

#include "vorion/support/ChildGroup.h"
#include "vorion/support/Diagnostics.h"
#include "vorion/support/RemovedAtEnd.h"
#include "vorion/support/StatusLine.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <fcntl.h>
#include <filesystem>
#include <fmt/format.h>
#include <new>
#include <sys/resource.h>
#include <system_error>
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
             fmt::format("cannot write: {}, expected an open output stream",
                         Cause ? std::strerror(Cause) : "not all was taken")});
}

/// Of the tool; empty before its main function.
std::string_view ToolName;

/// What is left to do where no destructor is called, as in the handler of a
/// signal. Takes no memory, of which there may be none.
void tidyUp() {
  keepStatus();
  endChildGroups();
  removeAtEnd();
}

/// As tidyUp().
int reportLimit(std::string_view What) {
  tidyUp();
  for (const std::string_view Part :
       {ToolName.empty() ? std::string_view(program_invocation_short_name)
                         : ToolName,
        std::string_view(": error: "), What, std::string_view("\n")})
    if (::write(STDERR_FILENO, Part.data(), Part.size()) < 0)
      break;
  return static_cast<int>(ExitCode::LimitReached);
}

int reportNoMemory() {
  return reportLimit(
      "out of memory, expected a smaller input or a host with more memory");
}

void endWithoutTime(int /*Signal*/) {
  ::_exit(reportLimit("the limit of processor time (ulimit -t) is reached, "
                      "expected a higher one"));
}

/// The action of the signal is the default one again.
void endBy(int Signal) {
  tidyUp();
  static_cast<void>(::raise(Signal));
}

/// Limits of the shell (ulimit) whose signals end a process without a message.
void catchLimits() {
  // A file that may not grow is an error of the write.
  std::signal(SIGXFSZ, SIG_IGN);
  std::signal(SIGXCPU, endWithoutTime);
  // No process learns of the hard limit: the signal is to come before it.
  struct rlimit Time{};
  if (::getrlimit(RLIMIT_CPU, &Time) == 0 && Time.rlim_max != RLIM_INFINITY &&
      Time.rlim_max > 1 && Time.rlim_cur == Time.rlim_max) {
    --Time.rlim_cur;
    ::setrlimit(RLIMIT_CPU, &Time);
  }
}

/// Memory may run out in any thread and in code of others, where an exception
/// would end the process with neither a message nor an exit code.
[[noreturn]] void endWithoutMemory() { ::_exit(reportNoMemory()); }

/// Before the objects of the program that are made before its main function:
/// these take memory too. 101 is the first that programs may have.
[[gnu::constructor(101)]] void catchMissingMemory() {
  std::set_new_handler(endWithoutMemory);
}

} // namespace

void catchEndingSignals() {
  for (const int Signal : {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM}) {
    struct sigaction Action{};
    if (::sigaction(Signal, nullptr, &Action) != 0 ||
        Action.sa_handler != SIG_DFL)
      continue;
    Action.sa_handler = endBy;
    Action.sa_flags = static_cast<int>(SA_RESETHAND) | SA_NODEFER;
    ::sigaction(Signal, &Action, nullptr);
  }
}

int runTool(std::string_view Tool, const std::function<int()> &Body) {
  keepStandardStreams();
  ToolName = Tool;
  catchEndingSignals();
  catchLimits();
  int Code = 0;
  try {
    Code = Body();
    errno = 0;
    const bool Flushed = std::fflush(stdout) == 0;
    if ((!Flushed || std::ferror(stdout)) && Code == 0)
      Code = reportFullOutput(Tool, errno);
  } catch (const std::bad_alloc &) {
    Code = reportNoMemory();
  } catch (const std::filesystem::filesystem_error &E) {
    Code = reportError(Tool,
                       {E.path1().string(),
                        fmt::format("{}, expected a path that can be resolved",
                                    E.code().message())});
  } catch (const std::system_error &E) {
    // A full standard output, or no room for a thread.
    Code = std::ferror(stdout)
               ? reportFullOutput(Tool, E.code().value())
               : reportError(
                     Tool,
                     {"",
                      fmt::format("{}, expected a host with enough resources",
                                  E.what()),
                      ExitCode::LimitReached});
  } catch (const std::exception &E) {
    Code = reportError(
        Tool,
        {"", fmt::format("internal error: {}, expected no exception", E.what()),
         ExitCode::Internal});
  }
  return Code;
}

} // namespace vorion
