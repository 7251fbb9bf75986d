/// A source location of a program.
#pragma once

#include <string>

namespace vorion::isasim {

struct SourcePlace {
  std::string File;
  unsigned Line = 0;
  /// The innermost function, including inlined ones; empty if unknown.
  std::string Function;
  /// The instruction has no line in the debug information, for example after
  /// merging two instructions: this is the line of the nearest preceding
  /// instruction with one.
  bool IsNear = false;

  /// "file:line", or "near file:line".
  std::string text() const;
};

} // namespace vorion::isasim
