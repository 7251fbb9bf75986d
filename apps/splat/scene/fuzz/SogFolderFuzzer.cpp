// Data sets and indices of streamed scenes in memory: the bytes are a file
// after another, each after its name's and its own length.
#include "scene/formats/SogFolder.h"

#include <cstdint>
#include <cstdlib>
#include <map>

using namespace vorion;
using namespace vorion::splat;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *Data, std::size_t Size) {
  Bytes Rest(reinterpret_cast<const std::byte *>(Data), Size);
  std::map<std::string, Bytes> Files;
  while (Rest.size() >= 4) {
    const std::size_t NameSize = byteAt(Rest, 0);
    const std::size_t FileSize =
        byteAt(Rest, 1) | byteAt(Rest, 2) << 8 | byteAt(Rest, 3) << 16;
    Rest = Rest.subspan(4);
    if (NameSize + FileSize > Rest.size())
      break;
    Files[std::string(asText(Rest.first(NameSize)))] =
        Rest.subspan(NameSize, FileSize);
    Rest = Rest.subspan(NameSize + FileSize);
  }
  const FileSource Read =
      [&](const std::string &Name,
          std::size_t Most) -> Expected<std::vector<std::byte>> {
    const auto It = Files.find(Name);
    if (It == Files.end() || It->second.size() > Most)
      return Error{Name, "no such file, expected it"};
    return std::vector<std::byte>(It->second.begin(), It->second.end());
  };
  if (const auto It = Files.find("meta.json"); It != Files.end())
    if (const auto R = parseSogData("input", "input", It->second, Read); !R)
      if (R.error().What.find('\n') != std::string::npos)
        std::abort();
  if (const auto It = Files.find("lod-meta.json"); It != Files.end())
    if (const auto R = parseStreamedSog("input", It->second, Read, {}); !R)
      if (R.error().What.find('\n') != std::string::npos)
        std::abort();
  return 0;
}
