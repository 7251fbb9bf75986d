/// A set-associative cache with banks and MSHRs.
#pragma once

#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/memory/CacheTags.h"
#include "vorion/isasim/Timing.h"

#include <algorithm>
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

/// When a line that a unit has asked for has come, or its write has been taken,
/// and which part of the wait belongs to the link. Times are cycles of the
/// chip.
struct Arrival {
  uint64_t At = 0; ///< Turn::Never while it is not known
  /// \name Its messages are on the link to the L2, or wait for it
  /// @{
  uint64_t RequestUntil = 0;         ///< the request until then
  uint64_t AnswerFrom = Turn::Never; ///< the answer from then until At
  /// @}

  bool crossesLink() const { return RequestUntil || AnswerFrom != Turn::Never; }

  /// Divides the cycles from \p From until \p Until, in which a unit waited for
  /// it, in the order of time: \p Spend gets whether a part is of the link, and
  /// where the part ends.
  template <typename Function>
  void divide(uint64_t From, uint64_t Until, Function Spend) const {
    const auto Part = [&](bool IsLink, uint64_t End) {
      End = std::min(End, Until);
      if (End > From) {
        Spend(IsLink, End);
        From = End;
      }
    };
    Part(true, RequestUntil);
    Part(false, AnswerFrom);
    Part(true, At);
    Part(false, Until);
  }
};

/// Who waits for a request's answer, and what it knows the request by.
struct Ticket {
  static constexpr uint32_t Nobody = std::numeric_limits<uint32_t>::max();
  uint32_t Unit = Nobody;
  uint32_t Tag = 0;
  uint64_t RequestUntil = 0; ///< see Arrival
};

struct CacheRequest {
  uint64_t Now;     ///< at the cache's door, in cycles
  uint32_t Address; ///< anywhere in the line
  CacheOp Op = CacheOp::Read;
  bool Keep = false;  ///< intersect hint: other tiles will want the line
  uint32_t Extra = 0; ///< cycles that an atomic holds its bank beyond one
  uint32_t Back = 0;  ///< cycles from the cache back to who asked
  uint32_t Port = 0;  ///< of a crossbar, if there is one
  Ticket From{};
  /// Is answered when a crossbar has taken the request from its port's queue.
  Ticket Dequeued{};
};

/// What a request that was not answered at once gets later.
struct Answer {
  Ticket To;
  uint64_t At;
  uint64_t AnswerFrom = Turn::Never; ///< see Arrival

  Arrival arrival() const { return {At, To.RequestUntil, AnswerFrom}; }
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

/// What the cores of a cluster share: one of Cache and CrossbarCache.
class SharedCache {
public:
  virtual ~SharedCache() = default;

  /// When the request is answered: a read's data are back with who asked, a
  /// write has been taken. Nothing if that is not known yet: then fill() or
  /// step() says it to the request's ticket.
  virtual std::optional<uint64_t> access(const CacheRequest &R) = 0;
  /// The line of \p Miss is there at \p Then. Appends what is known now.
  virtual void fill(uint32_t Miss, uint64_t Then,
                    std::vector<Answer> &Answers) = 0;

  /// \name What it does by itself
  /// @{
  /// The next cycle in which that may be something; Turn::Never if nothing is
  /// under way.
  virtual uint64_t nextEvent() const { return Turn::Never; }
  /// Does the cycle of nextEvent(). Appends the answers that it decides.
  virtual void step(std::vector<Answer> & /*Answers*/) {}
  /// @}

  /// Sends every dirty line down from \p Now on and forgets all lines; returns
  /// when the last has been sent.
  virtual uint64_t flush(uint64_t Now) = 0;

  /// Reports to \p Observers from now on what the banks of \p Own do; null for
  /// none.
  void watch(const MemoryWatch *Observers, BankPlace Own) {
    Watch = Observers;
    Place = Own;
  }
  const CacheTime &time() const { return Counted; }
  void clearCounters() { Counted = {}; }

protected:
  void tellBusy(uint32_t Bank, CycleSpan When) const;

  CacheTime Counted;
  const MemoryWatch *Watch = nullptr;

private:
  BankPlace Place;
};

class Cache final : public SharedCache {
public:
  Cache(const CacheShape &Shape, MemoryBelow &Below);

  std::optional<uint64_t> access(const CacheRequest &R) override;
  void fill(uint32_t Miss, uint64_t Then,
            std::vector<Answer> &Answers) override;
  uint64_t flush(uint64_t Now) override;

private:
  /// A time that is not decided yet.
  static constexpr uint64_t Open = std::numeric_limits<uint64_t>::max();

  /// A request for a line that is on its way.
  struct Merged {
    Ticket From;
    uint64_t NotBefore; ///< it reaches its bank
    uint32_t Plus;      ///< cycles from the line's coming to the answer
  };
  /// What an MSHR holds, until another miss takes it.
  struct Mshr {
    uint32_t Number = 0; ///< of the line
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
  /// The MSHR of a bank that is free first, as far as is known.
  uint32_t firstMshr(uint32_t Bank) const;
  /// That of a line's note in Tags, which is one more than its number in the
  /// bank.
  uint32_t mshrOf(uint32_t Bank, uint32_t Note) const {
    return Bank * Shape.Mshrs + Note - 1;
  }
  uint64_t readyAt(uint32_t Bank, uint32_t Number, uint32_t Note) const;

  CacheShape Shape;
  MemoryBelow &Below;
  CacheTags Tags;
  Modulo OfBanks;
  std::vector<Bank> Banks;
  std::vector<uint64_t> MshrFreeAt; ///< by bank
  std::vector<Mshr> Mshrs;
};

} // namespace vorion::isasim
