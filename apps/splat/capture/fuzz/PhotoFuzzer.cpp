// Whatever the bytes are, there is a whole picture or one message.
#include "Photo.h"

#include <cstdint>
#include <cstdlib>

using namespace vorion::splat;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *Data,
                                      std::size_t Size) {
  const auto Read =
      decodePhoto("input", {reinterpret_cast<const std::byte *>(Data), Size});
  if (Read ? Read->Rgba.size() != 4 * Read->pixels()
           : Read.error().What.find('\n') != std::string::npos)
    std::abort();
  return 0;
}
