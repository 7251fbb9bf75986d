/// Where an address of a lane lies on the host, for instructions that go lane
/// by lane. Not for vector levels: they would share these functions.
#pragma once

#include "core/State.h"

namespace vorion::isasim {

inline bool inside(const Region &R, uint32_t Addr, uint32_t Bytes) {
  const uint32_t Offset = Addr - R.Lo;
  return Offset < R.Bytes && Bytes <= R.Bytes - Offset;
}

/// Whether lane \p Lane must not go to \p Addr, which is in the stack of
/// another lane.
inline bool isStray(const WarpState *S, unsigned Lane, uint32_t Addr) {
  const Region &Stack = S->Mem->Stack;
  return S->FirstStack != WarpState::NoOwnStack && inside(Stack, Addr, 1) &&
         S->Mem->stackOf(Addr) != S->FirstStack + Lane;
}

/// Memory that every instruction may write, except the image.
inline std::byte *dataAt(const MemoryView &M, uint32_t Addr, uint32_t Bytes) {
  for (const Region *R : {&M.Global, &M.Local, &M.High, &M.Rest[0], &M.Rest[1]})
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
  for (const Region *R : {&M.Image, &M.Whole[0], &M.Whole[1]})
    if (inside(*R, Addr, Bytes))
      return R->at(Addr);
  return nullptr;
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
