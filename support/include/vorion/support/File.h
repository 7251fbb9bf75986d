/// Whole files in, and files that appear under their name complete or not at
/// all.
#pragma once

#include "vorion/support/Expected.h"

#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <string>
#include <sys/stat.h>
#include <unistd.h>
#include <vector>

namespace vorion {

/// Reads all of \p Path; directories and unreadable files are errors.
inline Expected<std::vector<std::byte>> readFile(const std::string &Path) {
  std::FILE *F = std::fopen(Path.c_str(), "rb");
  if (!F)
    return Error{Path, std::string("cannot open: ") + std::strerror(errno) +
                           ", expected a readable file"};
  std::vector<std::byte> Bytes;
  struct stat Info{};
  if (fstat(fileno(F), &Info) == 0 && S_ISREG(Info.st_mode))
    Bytes.reserve(static_cast<std::size_t>(Info.st_size));
  std::byte Chunk[1 << 16];
  std::size_t Got = 0;
  while ((Got = std::fread(Chunk, 1, sizeof(Chunk), F)) > 0)
    Bytes.insert(Bytes.end(), Chunk, Chunk + Got);
  const int ReadErrno = std::ferror(F) ? errno : 0;
  std::fclose(F);
  if (ReadErrno)
    return Error{Path, std::string("cannot read: ") + std::strerror(ReadErrno) +
                           ", expected a readable file"};
  return Bytes;
}

/// Writes \p Size bytes beside \p Path and renames the result to it, so that
/// an interrupted run leaves either the old file or the new one.
inline Expected<Success> writeFileAtomically(const std::string &Path,
                                             const void *Data,
                                             std::size_t Size) {
  const std::string Aside = Path + ".tmp" + std::to_string(getpid());
  std::FILE *F = std::fopen(Aside.c_str(), "wb");
  if (!F)
    return Error{Path, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  const bool Wrote = std::fwrite(Data, 1, Size, F) == Size;
  const bool Closed = std::fclose(F) == 0;
  if (Wrote && Closed && std::rename(Aside.c_str(), Path.c_str()) == 0)
    return Success{};
  const int Cause = errno;
  std::remove(Aside.c_str());
  return Error{Path, std::string("cannot write: ") + std::strerror(Cause) +
                         ", expected a folder that can be written"};
}

inline Expected<Success> writeFileAtomically(const std::string &Path,
                                             const std::string &Text) {
  return writeFileAtomically(Path, Text.data(), Text.size());
}

} // namespace vorion
