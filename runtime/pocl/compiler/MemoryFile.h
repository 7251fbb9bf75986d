/// Files in memory: what the compiler passes to code and programs that read and
/// write files. No disk can be full for them.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace vorion {

class MemoryFile {
public:
  /// Empty, or with \p Contents. Whether there is room is known by problem().
  explicit MemoryFile(std::string_view Contents = {});
  MemoryFile(MemoryFile &&Other) noexcept
      : Descriptor(std::exchange(Other.Descriptor, -1)),
        Problem(Other.Problem) {}
  ~MemoryFile();

  /// An error's number, or 0. Limits of files' sizes are those of files in
  /// memory, too.
  int problem() const { return Problem; }
  int descriptor() const { return Descriptor; }
  /// Its name in this process.
  std::string path() const;
  std::string contents() const;

private:
  int Descriptor;
  int Problem;
};

} // namespace vorion
