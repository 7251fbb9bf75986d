#include "vorion/support/Hash.h"

#include <cstdint>
#include <fmt/format.h>

namespace vorion {

std::string fnv1a64(std::string_view Bytes) {
  uint64_t Hash = 0xcbf29ce484222325;
  for (const char C : Bytes)
    Hash = (Hash ^ static_cast<unsigned char>(C)) * 0x100000001b3;
  return fmt::format("{:016x}", Hash);
}

} // namespace vorion
