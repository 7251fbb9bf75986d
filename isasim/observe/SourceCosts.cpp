#include "observe/SourceCosts.h"

#include "vorion/support/File.h"

#include <sstream>

namespace vorion::isasim {

std::vector<std::string> sourceText(const std::string &Path) {
  std::vector<std::string> Lines;
  const Expected<std::vector<std::byte>> Bytes = readRegularFile(Path);
  if (!Bytes)
    return Lines;
  std::istringstream Text(std::string(
      reinterpret_cast<const char *>(Bytes->data()), Bytes->size()));
  for (std::string Line; std::getline(Text, Line);)
    Lines.push_back(Line);
  return Lines;
}

} // namespace vorion::isasim
