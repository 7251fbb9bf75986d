#include "vorion/support/Hash.h"

#define XXH_INLINE_ALL // the header alone: no library to link
#include <fmt/format.h>
#include <xxhash.h>

namespace vorion {

std::string hexOf(uint64_t Hash) { return fmt::format("{:016x}", Hash); }

std::string fnv1a64(std::string_view Bytes) { return hexOf(fnv1a(Bytes)); }

struct Xxh3::State {
  XXH3_state_t All;
};

Xxh3::Xxh3() : S(std::make_shared<State>()) { XXH3_64bits_reset(&S->All); }

void Xxh3::add(std::span<const std::byte> Bytes) {
  XXH3_64bits_update(&S->All, Bytes.data(), Bytes.size());
}

uint64_t Xxh3::value() const { return XXH3_64bits_digest(&S->All); }

} // namespace vorion
