// Whatever the bytes are, there are frames or one message.
#include "Transforms.h"

#include <cstdint>
#include <cstdlib>

using namespace vorion::splat;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *Data,
                                      std::size_t Size) {
  const Bytes File(reinterpret_cast<const std::byte *>(Data), Size);
  const auto Read = parseTransforms("input", File);
  if (!Read && (Read.error().What.empty() ||
                Read.error().What.find('\n') != std::string::npos))
    std::abort();
  const auto Points = parsePointCloud("input", File);
  if (Points && Points->Positions.size() != Points->Colours.size())
    std::abort();
  return 0;
}
