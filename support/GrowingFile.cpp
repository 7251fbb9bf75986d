#include "vorion/support/GrowingFile.h"

#include "vorion/support/File.h"

#include <cerrno>
#include <cstring>

namespace vorion {

Expected<GrowingFile> GrowingFile::open(const std::string &Path) {
  if (Path == "-")
    return Error{
        Path,
        "this output is written incrementally, expected the name of a file",
        ExitCode::Usage};
  if (auto Named = checkName(Path); !Named)
    return Named.error();
  std::FILE *F = std::fopen(Path.c_str(), "wb");
  if (!F)
    return Error{Path, std::string("cannot write: ") + std::strerror(errno) +
                           ", expected a folder that can be written"};
  return GrowingFile(Path, F);
}

Expected<Success> GrowingFile::complete(std::string_view What) const {
  if (std::fflush(Stream.get()) == 0 && !std::ferror(Stream.get()))
    return Success{};
  return incomplete(What);
}

Error GrowingFile::incomplete(std::string_view What) const {
  return {
      Path,
      fmt::format("cannot write all of it, expected free space for {}", What)};
}

} // namespace vorion
