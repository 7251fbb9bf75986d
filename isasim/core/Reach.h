/// Where an address of a lane lies on the host, for instructions that go lane
/// by lane. Not for vector levels: they would share these functions.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

inline bool inside(const Region &R, uint32_t Addr, uint32_t Bytes) {
  const uint32_t Offset = Addr - R.Lo;
  return Offset < R.Bytes && Bytes <= R.Bytes - Offset;
}

/// Memory that every instruction may write, except the image.
inline std::byte *dataAt(const MemoryView &M, uint32_t Addr, uint32_t Bytes) {
  for (const Region *R : {&M.Global, &M.Local, &M.High})
    if (inside(*R, Addr, Bytes))
      return R->at(Addr);
  // Aligned accesses stay within a word, and words are contiguous.
  if (inside(M.Stack, Addr, Bytes))
    return M.Stack.Host + M.stackOffset(Addr);
  return nullptr;
}

inline std::byte *readableAt(const MemoryView &M, uint32_t Addr,
                             uint32_t Bytes) {
  if (std::byte *At = dataAt(M, Addr, Bytes))
    return At;
  return inside(M.Image, Addr, Bytes) ? M.Image.at(Addr) : nullptr;
}

inline std::byte *writableAt(const MemoryView &M, uint32_t Addr,
                             uint32_t Bytes) {
  if (std::byte *At = dataAt(M, Addr, Bytes))
    return At;
  for (unsigned N = 0; N != M.NumImageWritable; ++N)
    if (inside(M.ImageWritable[N], Addr, Bytes))
      return M.ImageWritable[N].at(Addr);
  return nullptr;
}

} // namespace vorion::isasim
