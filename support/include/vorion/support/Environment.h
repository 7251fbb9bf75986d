/// Environment variables.
#pragma once

#include <cstdlib>

namespace vorion {

/// The value of the variable \p Name; null if it is unset or empty. An empty
/// variable counts as unset, as in the XDG base directory specification, so
/// that a user can disable a variable for one command.
inline const char *environmentVariable(const char *Name) {
  const char *Text = std::getenv(Name);
  return Text && *Text ? Text : nullptr;
}

} // namespace vorion
