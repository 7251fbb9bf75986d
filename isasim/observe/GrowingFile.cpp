#include "observe/GrowingFile.h"

#include <cerrno>
#include <cstring>

namespace vorion::isasim {

Expected<GrowingFile> GrowingFile::open(const std::string &Path) {
  std::FILE *F = std::fopen(Path.c_str(), "wb");
  if (!F)
    return Error{Path, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  return GrowingFile(Path, F);
}

Expected<Success> GrowingFile::complete() const {
  if (std::fflush(Stream.get()) == 0 && !std::ferror(Stream.get()))
    return Success{};
  return Error{Path, "cannot write all of it, expected room for what is "
                     "observed"};
}

} // namespace vorion::isasim
