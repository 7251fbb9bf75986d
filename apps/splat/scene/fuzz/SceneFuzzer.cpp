// Whatever the bytes are, a reader gives a whole scene or one message.
#include "scene/formats/Formats.h"

#include <cstdint>
#include <cstdlib>

using namespace vorion::splat;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t *Data, std::size_t Size) {
  const auto Read = FUZZ_PARSE(
      "input", {reinterpret_cast<const std::byte *>(Data), Size}, {});
  if (!Read) {
    if (Read.error().What.empty() ||
        Read.error().What.find('\n') != std::string::npos)
      std::abort();
    return 0;
  }
  const Scene &S = Read->Gaussians;
  if (S.Means.size() != 3 * S.size() || S.LogScales.size() != 3 * S.size() ||
      S.Quats.size() != 4 * S.size() ||
      S.Sh.size() != 3 * S.size() * S.coefficients())
    std::abort();
  return 0;
}
