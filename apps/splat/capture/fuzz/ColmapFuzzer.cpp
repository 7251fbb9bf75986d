// A model in one input: whether it is text, then each file after its size.
#include "Colmap.h"

#include <cstdint>
#include <cstdlib>

using namespace vorion::splat;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *Data,
                                      std::size_t Size) {
  Bytes Rest(reinterpret_cast<const std::byte *>(Data), Size);
  if (Rest.empty())
    return 0;
  const bool Text = byteAt(Rest, 0) % 2 != 0;
  Rest = Rest.subspan(1);
  Bytes Parts[3];
  for (Bytes &Part : Parts) {
    if (Rest.size() < 2)
      return 0;
    const std::size_t Length =
        std::min<std::size_t>(load<std::uint16_t>(Rest, 0), Rest.size() - 2);
    Part = Rest.subspan(2, Length);
    Rest = Rest.subspan(2 + Length);
  }
  const ColmapFiles Files{
      {"cameras", Parts[0]}, {"images", Parts[1]}, {"points", Parts[2]}};
  const auto Read = Text ? parseColmapText(Files) : parseColmapBinary(Files);
  if (!Read && (Read.error().What.empty() ||
                Read.error().What.find('\n') != std::string::npos))
    std::abort();
  return 0;
}
