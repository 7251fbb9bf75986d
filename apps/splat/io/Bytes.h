/// Access to the bytes of a file.
#pragma once

#include "vorion/support/Printable.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>
#include <string_view>

namespace vorion::splat {

static_assert(std::endian::native == std::endian::little,
              "numbers are copied between file and memory as they are");

using Bytes = std::span<const std::byte>;

inline std::string_view asText(Bytes B) {
  return {reinterpret_cast<const char *>(B.data()), B.size()};
}

/// The number of type \p T at byte \p At, which need not be aligned.
template <typename T> T load(Bytes B, std::size_t At) {
  assert(At + sizeof(T) <= B.size());
  T Value;
  std::memcpy(&Value, B.data() + At, sizeof(T));
  return Value;
}

inline unsigned byteAt(Bytes B, std::size_t At) { return load<uint8_t>(B, At); }

/// Maximum unpacked size of \p Encoded bytes of an archive or picture: Deflate
/// cannot exceed 1032:1, and reasonable data of other codecs do not, plus a
/// constant for small files. Bounds memory by the file's size.
constexpr std::size_t unpackLimit(std::size_t Encoded) {
  constexpr std::size_t Deflate = 1032, Small = std::size_t(4) << 20;
  return Encoded * Deflate + Small;
}

} // namespace vorion::splat
