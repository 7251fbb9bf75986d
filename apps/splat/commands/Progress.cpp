#include "commands/Progress.h"

#include "vorion/support/Terminal.h"

#include <cstdio>
#include <fmt/format.h>

namespace vorion::splat {

std::function<void(std::string_view)> progress() {
  if (!canOverwrite())
    return {};
  return [](std::string_view Stage) {
    std::fputs(fmt::format("\r\033[Ksplat: {} ...", Stage).c_str(), stderr);
  };
}

void endProgress() {
  if (canOverwrite())
    std::fputs("\r\033[K", stderr);
}

} // namespace vorion::splat
