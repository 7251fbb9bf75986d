/// The variables of the environment.
#pragma once

#include <cstdlib>

namespace vorion {

/// The text of the variable \p Name; null if it is unset. A variable that is
/// empty counts as unset, as the XDG base directory specification has it: that
/// is how a shell's user takes one back for one command.
inline const char *environmentVariable(const char *Name) {
  const char *Text = std::getenv(Name);
  return Text && *Text ? Text : nullptr;
}

} // namespace vorion
