/// A file in memory, for code that reads and writes files.
#pragma once

#include <string>
#include <string_view>

namespace vorion {

class MemoryFile {
public:
  /// Empty, or with \p Contents. Whether there is memory is known by isGood().
  explicit MemoryFile(std::string_view Contents = {});
  MemoryFile(const MemoryFile &) = delete;
  MemoryFile &operator=(const MemoryFile &) = delete;
  ~MemoryFile();

  bool isGood() const { return Good; }
  int descriptor() const { return Descriptor; }
  /// Its name in this process.
  std::string path() const;
  std::string contents() const;

private:
  int Descriptor;
  bool Good;
};

/// While it lives, standard output goes to \p File.
class OutputTo {
public:
  explicit OutputTo(const MemoryFile &File);
  OutputTo(const OutputTo &) = delete;
  OutputTo &operator=(const OutputTo &) = delete;
  ~OutputTo();

private:
  int Before;
};

} // namespace vorion
