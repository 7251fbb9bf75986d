/// Internal to the library: the bytes of one .npy file.
#pragma once

#include "io/Bytes.h"
#include "io/Npz.h"

#include <string>

namespace vorion::splat {

/// The header of a .npy file.
struct NpyHeader {
  std::string Type; ///< as NpyArray has it
  std::vector<std::size_t> Shape;
  bool IsFortran = false; ///< first index fastest
  std::size_t Begin = 0;  ///< of the elements in the file, bytes
  std::size_t Size = 0;   ///< of all elements, bytes
};

/// Maximum size in bytes of a header that is read.
inline constexpr std::size_t MostNpyStart = std::size_t{1} << 17;

/// Reads the header of a file that begins with \p Start.
Expected<NpyHeader> parseNpyHeader(const std::string &Where, Bytes Start);

/// \p A as a version 1.0 .npy file.
std::string formatNpy(const NpyArray &A);

} // namespace vorion::splat
