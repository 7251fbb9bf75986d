/// Files that grow during a run.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace vorion {

/// Is not written aside: a reader may follow it, and what was written before a
/// crash is what it is read for.
class GrowingFile {
public:
  /// "-" is refused: standard output is for what is written at once.
  static Expected<GrowingFile> open(const std::string &Path);

  std::FILE *stream() const { return Stream.get(); }
  /// An error if it lacks some of what was written to it, which \p What names.
  Expected<Success> complete(std::string_view What = "what is observed") const;
  Error incomplete(std::string_view What) const;

private:
  struct Closer {
    void operator()(std::FILE *F) const { std::fclose(F); }
  };
  GrowingFile(std::string Path, std::FILE *F)
      : Path(std::move(Path)), Stream(F) {}
  std::string Path;
  std::unique_ptr<std::FILE, Closer> Stream;
};

/// Appends to \p To. A file that takes no more is no reason to end a run, and
/// observers must not throw (fmt::print() does): the file's tool looks at the
/// stream's error when a run has ended.
template <typename... Values>
void append(std::FILE *To, fmt::format_string<Values...> Format,
            Values &&...Of) {
  const std::string Text = fmt::format(Format, std::forward<Values>(Of)...);
  static_cast<void>(std::fwrite(Text.data(), 1, Text.size(), To));
}

} // namespace vorion
