#include "vorion/support/StatusLine.h"

#include "vorion/support/Printable.h"
#include "vorion/support/Terminal.h"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <string>
#include <unistd.h>

namespace vorion {
namespace {

constexpr std::string_view Clear = "\r\033[K";

/// Whether the cursor is behind the line.
volatile std::sig_atomic_t IsShown = 0;

void write(std::string_view Text) {
  static_cast<void>(std::fwrite(Text.data(), 1, Text.size(), stderr));
}

/// The action of the signal is the default one again.
void endBy(int Signal) {
  keepStatus();
  static_cast<void>(std::raise(Signal));
}

/// Whoever handles a signal of its own goes on to do so.
bool catchInterrupts() {
  for (const int Signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction Action{};
    if (::sigaction(Signal, nullptr, &Action) != 0 ||
        Action.sa_handler != SIG_DFL)
      continue;
    Action.sa_handler = endBy;
    Action.sa_flags = SA_RESETHAND | SA_NODEFER;
    ::sigaction(Signal, &Action, nullptr);
  }
  return true;
}

} // namespace

void showStatus(std::string_view Text) {
  if (!canOverwrite())
    return;
  [[maybe_unused]] static const bool AreCaught = catchInterrupts();
  // A terminal begins a new line when its last column is filled.
  const std::size_t Columns = columnsOf(STDERR_FILENO).value_or(80);
  const std::string Shown = escaped(Text);
  IsShown = 1;
  write(std::string(Clear).append(
      firstColumns(Shown, std::max<std::size_t>(Columns, 2) - 1)));
}

void clearStatus() {
  if (IsShown != 0)
    write(Clear);
  IsShown = 0;
}

void keepStatus() {
  if (IsShown != 0 && ::write(STDERR_FILENO, "\n", 1) < 0)
    return;
  IsShown = 0;
}

} // namespace vorion
