#include "vorion/support/Terminal.h"

#include <cstdlib>
#include <string_view>
#include <unistd.h>

namespace vorion {

static std::string_view variable(const char *Name) {
  const char *Value = std::getenv(Name);
  return Value ? Value : "";
}

bool canOverwrite() {
  const std::string_view Kind = variable("TERM");
  return isatty(STDERR_FILENO) != 0 && !Kind.empty() && Kind != "dumb";
}

bool canColour() { return canOverwrite() && variable("NO_COLOR").empty(); }

} // namespace vorion
