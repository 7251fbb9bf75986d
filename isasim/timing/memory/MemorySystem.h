/// Everything below cores and rasterizers: the link to the L2, its slices,
/// last-level cache, DRAM.
#pragma once

#include "timing/memory/Cache.h"
#include "timing/memory/CrossbarCache.h"
#include "timing/memory/DramChannels.h"
#include "timing/memory/L2Link.h"
#include "timing/memory/LineWriters.h"
#include "timing/memory/MemoryWatch.h"

#include <algorithm>
#include <deque>
#include <memory>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Memory of fixed latency in place of the L2 and everything behind it, or of
/// what lies behind the L2, for comparisons. Accepts a line per cycle, in call
/// order.
class FixedMemory {
public:
  /// None if \p CyclesIn is 0.
  explicit FixedMemory(uint32_t CyclesIn) : Cycles(CyclesIn) {}

  bool exists() const { return Cycles != 0; }

  /// When a read's line is back with who asked, or a write has been taken.
  uint64_t access(const CacheRequest &R) {
    const uint64_t Taken = std::max(R.Now, FreeAt);
    FreeAt = Taken + 1 + R.Extra;
    if (R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole)
      return Taken;
    return Taken + R.Extra + Cycles + R.Back;
  }

private:
  const uint32_t Cycles;
  uint64_t FreeAt = 0;
};

/// Where a unit reaches memory.
struct MemoryPort {
  unsigned Cluster = 0;
  uint32_t Unit = 0; ///< what it is called in answers
  uint32_t Port = 0; ///< of the cluster's crossbar
};

/// A request is answered at once where its answer is known, as of a hit. The
/// others are answered by advance(), whose owner calls it in the order of time.
class MemorySystem {
public:
  /// \p Ports: of a cluster, that a crossbar in front of its L2 slice has.
  MemorySystem(const TimingConfig &Params, unsigned Clusters,
               uint32_t Ports = 1);
  MemorySystem(const MemorySystem &) = delete;
  MemorySystem &operator=(const MemorySystem &) = delete;

  /// A request at \p Port; see SharedCache::access. Atomics are done
  /// where all who may meet at the word come together: in the L2 slice of a
  /// device with one cluster, else in the last-level cache. Changes \p R, of
  /// which it makes no copy.
  std::optional<Arrival> access(const MemoryPort &Port, CacheRequest &R);
  std::optional<Arrival> access(const MemoryPort &Port, CacheRequest &&R) {
    return access(Port, R);
  }
  /// Whether a request waits in its port until a crossbar takes it. Then
  /// CacheRequest::Dequeued is answered.
  static bool reportsDequeues(const TimingConfig &Params) {
    return Params.L2.Crossbar && !Params.L2.FixedCycles &&
           !L2Link::exists(Params);
  }
  /// The same of a unit on the L2's side of the link, whose ticket's unit has
  /// the bit IsBehindLink. All who share memory see its writes.
  std::optional<uint64_t> accessBehindLink(const CacheRequest &R);
  static constexpr uint32_t IsBehindLink = 1U << 29;
  /// The writes of the run, kept if cores have data caches.
  const LineWriters &writers() const { return Writers; }
  /// Cycles from a write until it has been taken, if nothing is in its way.
  static uint32_t writeCycles(const TimingConfig &Params);

  /// The next cycle in which something may be decided; Turn::Never if nothing
  /// is under way.
  uint64_t nextEvent() const {
    if (!HasLink)
      return nextEventInL2();
    // Every step of the clock asks, and most are told the same.
    const uint64_t Next = std::min(nextEventInL2(), Link.nextAnswer());
    if (Next != NextInL2) {
      NextInL2 = Next;
      NextOnChip = Link.toChip(Next);
    }
    return NextOnChip;
  }
  /// Goes on until lines have come or to the end of cycle \p Until. Appends
  /// the answers that are known by then.
  void advance(uint64_t Until, std::vector<Answer> &Answers);

  /// The end of a run at \p Now: slices of several clusters do not watch each
  /// other, so they hand on what they hold. Returns when that is done.
  uint64_t endRun(uint64_t Now);
  /// Then, with \p End what the whole run has come to: DRAM that is not asked
  /// for anything is refreshed until then.
  void idleUntil(uint64_t End);

  /// Notifies \p Observers from now on; null for none.
  void watch(const TimeWatch *Observers);

  /// A run begins at \p Now.
  void begin(uint64_t Now);
  /// Of a run until \p End.
  void report(TimeReport &R, uint64_t End) const;

private:
  /// From a slice to the last-level cache, or what stands in its place.
  class LlcDoor final : public MemoryBelow {
  public:
    LlcDoor(MemorySystem &OfIn, uint32_t SliceIn) : Of(OfIn), Slice(SliceIn) {}
    std::optional<uint64_t> fetch(uint64_t Now, uint32_t Address, bool Keep,
                                  uint32_t Miss) override {
      return Of.accessLlc({.Now = Now,
                           .Address = Address,
                           .Keep = Keep,
                           .From = {IsSlice | Slice, Miss}});
    }
    void writeBack(uint64_t Now, uint32_t Address) override {
      Of.accessLlc({.Now = Now, .Address = Address, .Op = CacheOp::WriteWhole});
    }

  private:
    MemorySystem &Of;
    uint32_t Slice;
  };
  struct Slice {
    Slice(MemorySystem &Of, uint32_t Number) : Door(Of, Number) {}
    LlcDoor Door;
    std::unique_ptr<SharedCache> L2;
  };
  /// A bit of tickets whose unit is a slice.
  static constexpr uint32_t IsSlice = 1U << 30;

  /// An answer of the L2: goes over the link, unless it is for a unit behind
  /// it.
  void give(const Answer &A, std::vector<Answer> &Answers);
  // In cycles of the L2, or of what stands in its place.
  std::optional<uint64_t> accessL2(unsigned Cluster, const CacheRequest &R);
  std::optional<uint64_t> accessLlc(const CacheRequest &R);
  uint64_t nextEventInL2() const {
    return HasCrossbars ? std::min(Ram.nextEvent(), firstSlice().nextEvent())
                        : Ram.nextEvent();
  }
  /// The L2 that goes on first.
  SharedCache &firstSlice() const;
  void advanceL2(uint64_t Until, std::vector<Answer> &Answers);
  void advanceRam(uint64_t Until, std::vector<Answer> &Answers);

  const bool KeepsWriters;
  LineWriters Writers;
  const bool HasLink;
  L2Link Link;
  FixedMemory Fixed, FixedBelow; ///< in place of the L2, and of what is below
  DramChannels Ram;
  Cache Llc;
  std::deque<Slice> Slices; ///< by cluster
  const bool HasCrossbars;
  const uint32_t LastPort; ///< of units behind the link
  uint32_t L2HitCycles;
  mutable uint64_t NextInL2 = 0, NextOnChip = 0; ///< what nextEvent() said
  std::vector<DramChannels::Fill> Fills;
  std::vector<Answer> FromLlc, FromL2;
  std::optional<MemoryWatch> Watch;
};

} // namespace vorion::isasim
