#include "region/MemoryChanges.h"

#include "mem/TouchedPages.h"

#include <algorithm>
#include <cstring>

namespace vorion::isasim {

void Digest::add(uint64_t Word) {
  constexpr uint64_t Odd = 0x9E3779B97F4A7C15; // 2^64 by the golden ratio
  Sum = (Sum ^ Word) * Odd;
  Sum ^= Sum >> 32;
}

void Digest::add(std::span<const std::byte> Bytes) {
  add(uint64_t{Bytes.size()});
  uint64_t Word = 0;
  for (; Bytes.size() >= sizeof(Word); Bytes = Bytes.subspan(sizeof(Word))) {
    std::memcpy(&Word, Bytes.data(), sizeof(Word));
    add(Word);
  }
  for (const std::byte B : Bytes)
    add(static_cast<uint64_t>(B));
}

size_t MemoryChanges::Range::sizeOf(uint32_t Page) const {
  return std::min<size_t>(PageBytes, Now.size() - Page * PageBytes);
}

std::byte *MemoryChanges::Range::now(uint32_t Page) const {
  return Now.data() + Page * PageBytes;
}

std::byte *MemoryChanges::Range::before(uint32_t Page) const {
  return Before.data() + Page * PageBytes;
}

Expected<MemoryChanges> MemoryChanges::of(const Machine &M) {
  std::vector<Range> Ranges;
  for (const std::span<std::byte> Now : M.memory()) {
    Expected<Mapping> Before = Mapping::make(Now.size());
    if (!Before)
      return Before.error();
    Ranges.push_back({Now, std::move(*Before)});
  }
  return MemoryChanges(std::move(Ranges));
}

std::vector<MemoryChanges::Page> MemoryChanges::take() {
  std::vector<Page> Changed;
  for (uint32_t N = 0; N != Ranges.size(); ++N) {
    const Range &R = Ranges[N];
    // Nobody gives pages back, so what was never touched has not changed.
    const std::vector<bool> Touched = touchedPages(R.Now, PageBytes);
    for (uint32_t P = 0; R.has(P); ++P)
      if (Touched[P] && std::memcmp(R.before(P), R.now(P), R.sizeOf(P)) != 0) {
        std::memcpy(R.before(P), R.now(P), R.sizeOf(P));
        Changed.push_back({N, P});
      }
  }
  return Changed;
}

uint64_t MemoryChanges::takeDigest() {
  Digest D;
  for (const Page P : take()) {
    D.add(P.Range);
    D.add(P.Number);
    D.add(bytes(P));
  }
  return D.value();
}

std::span<const std::byte> MemoryChanges::bytes(Page P) const {
  const Range &R = Ranges[P.Range];
  return {R.before(P.Number), R.sizeOf(P.Number)};
}

size_t MemoryChanges::bytesOf(Page P) const {
  return P.Range < Ranges.size() && Ranges[P.Range].has(P.Number)
             ? Ranges[P.Range].sizeOf(P.Number)
             : 0;
}

void MemoryChanges::put(Page P, std::span<const std::byte> Bytes) {
  const Range &R = Ranges[P.Range];
  std::ranges::copy(Bytes, R.before(P.Number));
  std::ranges::copy(Bytes, R.now(P.Number));
}

} // namespace vorion::isasim
