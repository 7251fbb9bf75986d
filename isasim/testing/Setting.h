/// Random tests that run for longer than the suite does
/// (docs/random-tests.md).
#pragma once

#include <cstdlib>

namespace vorion {

/// The number in the environment variable \p Name, or \p Default.
inline unsigned setting(const char *Name, unsigned Default) {
  const char *Text = std::getenv(Name);
  return Text ? static_cast<unsigned>(std::strtoul(Text, nullptr, 0)) : Default;
}

} // namespace vorion
