/// Non-cryptographic hashes of inputs.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>

namespace vorion {

/// FNV-1a, 64 bits, http://www.isthe.com/chongo/tech/comp/fnv/: of what
/// reports, checkpoints and draws of random numbers depend on, so that it
/// stays.
/// \p Hash is that of the bytes before, if there are any.
constexpr uint64_t fnv1a(std::string_view Bytes,
                         uint64_t Hash = 0xcbf29ce484222325) {
  for (const char C : Bytes)
    Hash = (Hash ^ static_cast<unsigned char>(C)) * 0x100000001b3;
  return Hash;
}

/// A hash as 16 hexadecimal digits.
std::string hexOf(uint64_t Hash);
std::string fnv1a64(std::string_view Bytes);

/// XXH3, 64 bits, of bytes that come one part after the other: for large data,
/// because it is much faster.
class Xxh3 {
public:
  Xxh3();
  void add(std::span<const std::byte> Bytes);
  uint64_t value() const;

private:
  struct State;
  std::shared_ptr<State> S;
};

} // namespace vorion
