/// A place in the source of a program.
#pragma once

#include <string>

namespace vorion::isasim {

struct SourcePlace {
  std::string File;
  unsigned Line = 0;
  /// The innermost function, inlined ones too; empty if not known.
  std::string Function;
  /// The compiler gave the instruction no line, as where it made one of two:
  /// this is the line of the nearest instruction before it that has one.
  bool IsNear = false;

  /// "file:line", or "near file:line".
  std::string text() const;
};

} // namespace vorion::isasim
