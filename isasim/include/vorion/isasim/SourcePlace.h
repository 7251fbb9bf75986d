/// A place in the source of a program.
#pragma once

#include <string>

namespace vorion::isasim {

struct SourcePlace {
  std::string File;
  unsigned Line = 0;
  /// The innermost function, inlined ones too; empty if not known.
  std::string Function;

  /// "file:line".
  std::string text() const;
};

} // namespace vorion::isasim
