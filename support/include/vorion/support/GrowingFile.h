/// Output files that are appended to during a run.
#pragma once

#include "vorion/support/Expected.h"

#include <cstdio>
#include <fmt/format.h>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

namespace vorion {

/// Not written atomically: a reader may follow it, and the part written before
/// a crash is useful.
class GrowingFile {
public:
  /// "-" is rejected: standard output is for files that are written at once.
  static Expected<GrowingFile> open(const std::string &Path);

  std::FILE *stream() const { return Stream.get(); }
  /// Error: not everything could be written. \p What names the contents.
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

/// Appends to \p To. Write errors do not stop a run, and observers must not
/// throw (fmt::print() does): the observer checks the error state of the stream
/// after the run.
template <typename... Values>
void append(std::FILE *To, fmt::format_string<Values...> Format,
            Values &&...Of) {
  const std::string Text = fmt::format(Format, std::forward<Values>(Of)...);
  static_cast<void>(std::fwrite(Text.data(), 1, Text.size(), To));
}

} // namespace vorion
