/// A set-associative cache with banks, MSHRs, write-back, and LRU replacement
/// that may spare lines of Gaussians which other tiles will want.
#pragma once

#include "timing/common/TimeObserver.h"
#include "vorion/isasim/Timing.h"

#include <cstdint>
#include <deque>
#include <limits>
#include <optional>
#include <vector>

namespace vorion::isasim {

class MemoryWatch;

/// What a request does with its line.
enum class CacheOp : uint8_t {
  Read,
  Write,      ///< of some of its bytes: the line is fetched
  WriteWhole, ///< of all: nothing is fetched
  Atomic,
};

/// Who waits for a request's answer, and what it knows the request by.
struct Ticket {
  static constexpr uint32_t Nobody = std::numeric_limits<uint32_t>::max();
  uint32_t Unit = Nobody;
  uint32_t Tag = 0;
};

struct CacheRequest {
  uint64_t Now;     ///< at the cache's door, in cycles
  uint32_t Address; ///< anywhere in the line
  CacheOp Op = CacheOp::Read;
  bool Keep = false;  ///< intersect hint: other tiles will want the line
  uint32_t Extra = 0; ///< cycles that an atomic holds its bank beyond one
  uint32_t Back = 0;  ///< cycles from the cache back to who asked
  Ticket From{};
};

/// What a request that was not answered at once gets later.
struct Answer {
  Ticket To;
  uint64_t At;
};

/// What lies below a cache.
class MemoryBelow {
public:
  virtual ~MemoryBelow() = default;
  /// When the line is there. Nothing if that is not decided yet: then
  /// Cache::fill() tells the cache, which knows the request as \p Miss.
  virtual std::optional<uint64_t> fetch(uint64_t Now, uint32_t Address,
                                        bool Keep, uint32_t Miss) = 0;
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
  /// write has been taken. Nothing if that is not known yet: then fill() says
  /// it to the request's ticket.
  std::optional<uint64_t> access(const CacheRequest &R);
  /// The line of \p Miss is there at \p Then. Appends what is known now.
  void fill(uint32_t Miss, uint64_t Then, std::vector<Answer> &Answers);

  /// Sends every dirty line down from \p Now on and forgets all lines; returns
  /// when the last has been sent.
  uint64_t flush(uint64_t Now);

  /// \p Observers are told from now on what the banks of \p Own do; null for
  /// nobody.
  void watch(const MemoryWatch *Observers, BankPlace Own) {
    Watch = Observers;
    Place = Own;
  }

  const CacheTime &time() const { return Counted; }
  void clearCounters() { Counted = {}; }

private:
  /// A time that is not decided yet.
  static constexpr uint64_t Open = std::numeric_limits<uint64_t>::max();
  static constexpr size_t None = std::numeric_limits<size_t>::max();

  struct Line {
    uint64_t ReadyAt = 0; ///< when its bytes have come
    uint32_t Miss = 0;    ///< its MSHR while that is open
  };
  /// \name Beside the order of a line's last use
  /// @{
  static constexpr uint64_t Kept = uint64_t{1} << 63; ///< it is spared once
  static constexpr uint64_t Dirty = uint64_t{1} << 62;
  static constexpr uint64_t OrderMask = Dirty - 1;
  /// @}
  /// A request for a line that is on its way.
  struct Merged {
    Ticket From;
    uint64_t NotBefore; ///< it reaches its bank
    uint32_t Plus;      ///< cycles from the line's coming to the answer
  };
  /// What an MSHR holds.
  struct Mshr {
    size_t Line = 0; ///< place in Lines
    std::vector<Merged> Waiting;
  };
  /// A bank works one request a cycle. Behind a miss that finds every MSHR
  /// taken by a line of which nobody knows when it comes, all requests wait.
  struct Bank {
    uint64_t FreeAt = 0;
    std::deque<CacheRequest> Waiting;
  };

  bool take(const CacheRequest &R, std::optional<uint64_t> &Answer);
  bool serve(const CacheRequest &R, std::optional<uint64_t> &Answer);
  /// \name Places in Lines, of ways of the set that begins at \p Set
  /// @{
  size_t find(uint32_t Number, size_t Set) const;
  size_t victim(size_t Set);
  /// @}
  /// The MSHR of a bank that is free first, as far as is known.
  uint32_t firstMshr(uint32_t Bank) const;

  CacheShape Shape;
  uint32_t Sets;
  MemoryBelow &Below;
  std::vector<uint32_t> Tags; ///< line number plus 1, 0 for none
  std::vector<Line> Lines;
  /// By line: the order of its last use, 0 for no line, and what it is. Apart
  /// from the lines, since every miss looks at those of a whole set and at no
  /// more.
  std::vector<uint64_t> LastUse;
  std::vector<Bank> Banks;
  std::vector<uint64_t> MshrFreeAt; ///< by bank
  std::vector<Mshr> Mshrs;
  uint64_t Uses = 0;
  CacheTime Counted;
  const MemoryWatch *Watch = nullptr;
  BankPlace Place;
};

} // namespace vorion::isasim
