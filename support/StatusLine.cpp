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

} // namespace

void showStatus(std::string_view Text) {
  if (!canOverwrite())
    return;
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
