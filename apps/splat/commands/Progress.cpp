#include "Progress.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace vorion::splat {

std::function<void(std::string_view)> progress() {
  if (isatty(STDERR_FILENO) == 0)
    return {};
  return [](std::string_view Stage) {
    fmt::print(stderr, "\r\033[Ksplat: {} ...", Stage);
    std::fflush(stderr);
  };
}

void endProgress() {
  if (isatty(STDERR_FILENO) != 0)
    fmt::print(stderr, "\r\033[K");
}

} // namespace vorion::splat
