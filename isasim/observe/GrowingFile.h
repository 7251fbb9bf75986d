/// Files that grow during a run.
#pragma once

#include <cstdio>
#include <fmt/format.h>
#include <utility>

namespace vorion::isasim {

/// Appends to \p To. A file that takes no more is no reason to end a run, and
/// observers must not throw (fmt::print() does): the session looks at the
/// stream's error when a run has ended.
template <typename... Values>
void append(std::FILE *To, fmt::format_string<Values...> Format,
            Values &&...Of) {
  const std::string Text = fmt::format(Format, std::forward<Values>(Of)...);
  static_cast<void>(std::fwrite(Text.data(), 1, Text.size(), To));
}

} // namespace vorion::isasim
