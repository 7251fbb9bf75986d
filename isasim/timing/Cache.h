/// A set-associative cache with banks, MSHRs, write-back, and LRU replacement
/// that may spare lines of Gaussians which other tiles will want.
#pragma once

#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vorion::isasim {

/// What a request does with its line.
enum class CacheOp : uint8_t {
  Read,
  Write,      ///< of some of its bytes: the line is fetched
  WriteWhole, ///< of all: nothing is fetched
  Atomic,
};

struct CacheRequest {
  uint64_t Now;     ///< at the cache's door, in cycles
  uint32_t Address; ///< anywhere in the line
  CacheOp Op = CacheOp::Read;
  bool Keep = false;  ///< intersect hint: other tiles will want the line
  uint32_t Extra = 0; ///< cycles that an atomic holds its bank beyond one
};

/// What lies below a cache.
class MemoryBelow {
public:
  virtual ~MemoryBelow() = default;
  /// When the line is there (a read), or has been taken (a write of all of it).
  virtual uint64_t fetch(uint64_t Now, uint32_t Address, bool Keep) = 0;
  virtual void writeBack(uint64_t Now, uint32_t Address) = 0;
};

/// Sizes of one cache.
struct CacheShape {
  uint32_t Bytes, Ways, Banks, Mshrs, HitCycles;
  bool Hint;
};

class Cache {
public:
  Cache(const CacheShape &Shape, MemoryBelow &Below);

  /// When the request is answered: a read's data are back with who asked, a
  /// write has been taken.
  uint64_t access(const CacheRequest &R);

  /// Sends every dirty line down from \p Now on and forgets all lines; returns
  /// when the last has been sent.
  uint64_t flush(uint64_t Now);

  const CacheTime &time() const { return Counted; }
  void clearCounters() { Counted = {}; }

private:
  struct Line {
    uint32_t Tag = 0; ///< line number plus 1, 0 for none
    bool Dirty = false;
    bool Keep = false;
    uint64_t Used = 0;    ///< order of uses
    uint64_t ReadyAt = 0; ///< when its bytes have come
  };
  /// A bank works one request a cycle and holds some misses.
  struct Bank {
    uint64_t FreeAt = 0;
    std::vector<uint64_t> MshrFreeAt; ///< a heap, the earliest on top
  };

  Line *find(uint32_t Number, Line *Set);
  Line &victim(Line *Set);
  uint64_t takeMshr(Bank &B, uint64_t Now);

  CacheShape Shape;
  uint32_t Sets;
  MemoryBelow &Below;
  std::vector<Line> Lines;
  std::vector<Bank> Banks;
  uint64_t Uses = 0;
  CacheTime Counted;
};

} // namespace vorion::isasim
