#include "OutOfMemory.h"

#include <llvm/Support/ErrorHandling.h>

#include <cerrno>
#include <cstdio>
#include <unistd.h>

namespace vorion {

namespace {

constexpr int ExitLimitReached = 5; // of the README's table

/// Allocates nothing.
[[noreturn]] void endWithoutMemory(void *, const char *, bool) {
  char Line[256];
  const int Length =
      snprintf(Line, sizeof(Line),
               "%s: error: memory ran out while a kernel was compiled, "
               "expected more\n",
               program_invocation_short_name);
  // Whether it can be printed changes nothing.
  [[maybe_unused]] const ssize_t Written =
      write(STDERR_FILENO, Line, static_cast<size_t>(Length));
  _exit(ExitLimitReached);
}

} // namespace

void endInOneLineWithoutMemory() {
  llvm::remove_bad_alloc_error_handler();
  llvm::install_bad_alloc_error_handler(endWithoutMemory);
}

} // namespace vorion
