/// Everything below cores and rasterizers: the link to the L2, its slices,
/// last-level cache, DRAM.
#pragma once

#include "timing/memory/Cache.h"
#include "timing/memory/DramChannels.h"
#include "timing/memory/L2Link.h"
#include "timing/memory/LineWriters.h"
#include "timing/memory/MemoryWatch.h"

#include <algorithm>
#include <deque>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Memory of fixed latency in place of the L2 and everything behind it, for
/// comparisons of cores alone. Accepts a line per cycle, in call order.
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

/// A request is answered at once where its answer is known, as of a hit. The
/// others are answered by advance(), whose owner calls it in the order of time.
class MemorySystem {
public:
  MemorySystem(const TimingConfig &Params, unsigned Clusters);
  MemorySystem(const MemorySystem &) = delete;
  MemorySystem &operator=(const MemorySystem &) = delete;

  /// A request of somebody in \p Cluster; see Cache::access. Atomics are done
  /// where all who may meet at the word come together: in the L2 slice of a
  /// device with one cluster, else in the last-level cache.
  std::optional<uint64_t> access(unsigned Cluster, const CacheRequest &R);
  /// The writes of the run, kept if cores have data caches.
  const LineWriters &writers() const { return Writers; }
  /// Cycles from a write until it has been taken, if nothing is in its way.
  static uint32_t writeCycles(const TimingConfig &Params);

  /// The next cycle in which something may be decided; Turn::Never if nothing
  /// is under way.
  uint64_t nextEvent() const {
    if (!HasLink)
      return Ram.nextEvent();
    // Every step of the clock asks, and most are told the same.
    const uint64_t Next = std::min(Ram.nextEvent(), Link.nextAnswer());
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

  /// \p Observers are told from now on; null for nobody.
  void watch(const TimeWatch *Observers);

  /// A run begins.
  void begin();
  void report(TimeReport &R) const;

private:
  /// From a slice to the last-level cache.
  class LlcDoor final : public MemoryBelow {
  public:
    LlcDoor(Cache &LlcIn, uint32_t SliceIn) : Llc(LlcIn), Slice(SliceIn) {}
    std::optional<uint64_t> fetch(uint64_t Now, uint32_t Address, bool Keep,
                                  uint32_t Miss) override {
      return Llc.access({.Now = Now,
                         .Address = Address,
                         .Keep = Keep,
                         .From = {IsSlice | Slice, Miss}});
    }
    void writeBack(uint64_t Now, uint32_t Address) override {
      Llc.access({.Now = Now, .Address = Address, .Op = CacheOp::WriteWhole});
    }

  private:
    Cache &Llc;
    uint32_t Slice;
  };
  struct Slice {
    Slice(const CacheShape &Shape, Cache &Llc, uint32_t Number)
        : Door(Llc, Number), L2(Shape, Door) {}
    LlcDoor Door;
    Cache L2;
  };
  /// A bit of tickets whose unit is a slice.
  static constexpr uint32_t IsSlice = 1U << 30;

  // In cycles of the L2, or of what stands in its place.
  std::optional<uint64_t> accessL2(unsigned Cluster, const CacheRequest &R);
  void advanceL2(uint64_t Until, std::vector<Answer> &Answers);

  const bool KeepsWriters;
  LineWriters Writers;
  const bool HasLink;
  L2Link Link;
  FixedMemory Fixed;
  DramChannels Ram;
  Cache Llc;
  std::deque<Slice> Slices; ///< by cluster
  uint32_t L2HitCycles;
  mutable uint64_t NextInL2 = 0, NextOnChip = 0; ///< what nextEvent() said
  std::vector<DramChannels::Fill> Fills;
  std::vector<Answer> FromLlc, FromL2;
  std::optional<MemoryWatch> Watch;
};

} // namespace vorion::isasim
