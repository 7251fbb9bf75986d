#include "commands/Progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace vorion::splat {

std::function<void(std::string_view)> progress() {
  if (isatty(STDERR_FILENO) == 0)
    return {};
  return [](std::string_view Stage) {
    std::fputs(fmt::format("\r\033[Ksplat: {} ...", Stage).c_str(), stderr);
  };
}

void endProgress() {
  if (isatty(STDERR_FILENO) != 0)
    std::fputs("\r\033[K", stderr);
}

} // namespace vorion::splat
