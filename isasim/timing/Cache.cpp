#include "timing/Cache.h"

#include <algorithm>

namespace vorion::isasim {

Cache::Cache(const CacheShape &ShapeIn, MemoryBelow &BelowIn)
    : Shape(ShapeIn),
      Sets(std::max(1U, Shape.Bytes / TimingLineBytes / Shape.Ways)),
      Below(BelowIn), Lines(size_t{Sets} * Shape.Ways), Banks(Shape.Banks) {
  for (Bank &B : Banks)
    B.MshrFreeAt.assign(Shape.Mshrs, 0);
}

Cache::Line *Cache::find(uint32_t Number, Line *Set) {
  for (uint32_t W = 0; W != Shape.Ways; ++W)
    if (Set[W].Tag == Number + 1)
      return &Set[W];
  return nullptr;
}

/// The least recently used line; with the hint, the least recently used one
/// without it, and the one that is spared loses its hint, so that lines which
/// no tile came for do not stay for ever.
Cache::Line &Cache::victim(Line *Set) {
  Line *Oldest = Set;
  Line *OldestPlain = nullptr;
  for (uint32_t W = 0; W != Shape.Ways; ++W) {
    Line &L = Set[W];
    if (L.Tag == 0)
      return L;
    if (L.Used < Oldest->Used)
      Oldest = &L;
    if (!L.Keep && (!OldestPlain || L.Used < OldestPlain->Used))
      OldestPlain = &L;
  }
  if (!Shape.Hint || !Oldest->Keep || !OldestPlain)
    return *Oldest;
  Oldest->Keep = false;
  ++Counted.Kept;
  return *OldestPlain;
}

uint64_t Cache::takeMshr(Bank &B, uint64_t Now) {
  std::pop_heap(B.MshrFreeAt.begin(), B.MshrFreeAt.end(), std::greater<>());
  const uint64_t At = std::max(Now, B.MshrFreeAt.back());
  Counted.MshrCycles += At - Now;
  return At;
}

uint64_t Cache::access(const CacheRequest &R) {
  const uint32_t Number = R.Address / TimingLineBytes;
  Bank &B = Banks[Number % Shape.Banks];
  const uint64_t At = std::max(R.Now, B.FreeAt);
  Counted.BankCycles += At - R.Now;
  B.FreeAt = At + 1 + R.Extra;
  const bool IsRead = R.Op == CacheOp::Read;
  ++(IsRead                    ? Counted.Reads
     : R.Op == CacheOp::Atomic ? Counted.Atomics
                               : Counted.Writes);
  Line *Set = &Lines[size_t{Number % Sets} * Shape.Ways];
  Line *L = find(Number, Set);
  // A write is taken when the bank has it; who wrote does not wait.
  const uint64_t Taken = At + Shape.HitCycles / 2;
  if (L) {
    L->Used = ++Uses;
    L->Dirty |= !IsRead;
    L->Keep |= R.Keep;
    ++(L->ReadyAt > At ? Counted.Merged : Counted.Hits);
    if (R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole)
      return Taken;
    return std::max(At, L->ReadyAt) + Shape.HitCycles + R.Extra;
  }

  Line &V = victim(Set);
  if (V.Tag && V.Dirty) {
    ++Counted.Writebacks;
    Below.writeBack(At, (V.Tag - 1) * TimingLineBytes);
  }
  V = {Number + 1, !IsRead, R.Keep, ++Uses, At};
  if (R.Op == CacheOp::WriteWhole)
    return Taken;
  const uint64_t Begin = takeMshr(B, At);
  // The tags have been looked up before the request goes down.
  V.ReadyAt = Below.fetch(Begin + Shape.HitCycles / 2, R.Address, R.Keep);
  B.MshrFreeAt.back() = V.ReadyAt;
  std::push_heap(B.MshrFreeAt.begin(), B.MshrFreeAt.end(), std::greater<>());
  // A miss that waits for an MSHR holds up its bank.
  B.FreeAt = std::max(B.FreeAt, Begin + 1 + R.Extra);
  if (R.Op == CacheOp::Write)
    return Begin + Shape.HitCycles / 2;
  return V.ReadyAt + Shape.HitCycles - Shape.HitCycles / 2 + R.Extra;
}

uint64_t Cache::flush(uint64_t Now) {
  std::vector<uint64_t> Sent(Shape.Banks, Now);
  for (Line &L : Lines) {
    if (L.Tag && L.Dirty) {
      ++Counted.Writebacks;
      Below.writeBack(Sent[(L.Tag - 1) % Shape.Banks]++,
                      (L.Tag - 1) * TimingLineBytes);
    }
    L = {};
  }
  return *std::max_element(Sent.begin(), Sent.end());
}

} // namespace vorion::isasim
