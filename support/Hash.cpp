#include "vorion/support/Hash.h"

#define XXH_INLINE_ALL // the header alone: no library to link
#include <fmt/format.h>
#include <xxhash.h>

namespace vorion {

std::string fnv1a64(std::string_view Bytes) {
  return fmt::format("{:016x}", fnv1a(Bytes));
}

uint64_t xxh3(std::span<const std::byte> Bytes) {
  return XXH3_64bits(Bytes.data(), Bytes.size());
}

} // namespace vorion
