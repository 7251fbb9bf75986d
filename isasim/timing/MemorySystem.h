/// Everything below cores and rasterizers: L2 slices, last-level cache, DRAM.
#pragma once

#include "timing/Cache.h"
#include "timing/Dram.h"

#include <memory>
#include <vector>

namespace vorion::isasim {

class MemorySystem {
public:
  MemorySystem(const TimingConfig &Params, unsigned Clusters);
  MemorySystem(const MemorySystem &) = delete;
  MemorySystem &operator=(const MemorySystem &) = delete;

  /// A request of somebody in \p Cluster; see Cache::access. Atomics are done
  /// where all who may meet at the word come together: in the L2 slice of a
  /// device with one cluster, else in the last-level cache.
  uint64_t access(unsigned Cluster, const CacheRequest &R);

  /// The end of a run at \p Now: slices of several clusters do not watch each
  /// other, so they hand on what they hold. Returns when that is done.
  uint64_t endRun(uint64_t Now);

  void clearCounters();
  void report(TimeReport &R) const;

private:
  /// Where cycles become picoseconds and come back.
  class DramDoor final : public MemoryBelow {
  public:
    DramDoor(const TimingConfig &Params)
        : Ram(Params.Dram), ClockMhz(Params.ClockMhz) {}
    uint64_t fetch(uint64_t Now, uint32_t Address, bool) override {
      return cycles(Ram.access(picoseconds(Now), Address, false));
    }
    void writeBack(uint64_t Now, uint32_t Address) override {
      Ram.access(picoseconds(Now), Address, true);
    }
    Dram Ram;

  private:
    static constexpr uint64_t PsTimesMhz = 1000000;
    uint64_t picoseconds(uint64_t Cycles) const {
      return Cycles * PsTimesMhz / ClockMhz;
    }
    uint64_t cycles(uint64_t Ps) const {
      return (Ps * ClockMhz + PsTimesMhz - 1) / PsTimesMhz;
    }
    uint64_t ClockMhz;
  };
  class LlcDoor final : public MemoryBelow {
  public:
    explicit LlcDoor(Cache &LlcIn) : Llc(LlcIn) {}
    uint64_t fetch(uint64_t Now, uint32_t Address, bool Keep) override {
      return Llc.access({.Now = Now, .Address = Address, .Keep = Keep});
    }
    void writeBack(uint64_t Now, uint32_t Address) override {
      Llc.access({.Now = Now, .Address = Address, .Op = CacheOp::WriteWhole});
    }

  private:
    Cache &Llc;
  };

  DramDoor Ram;
  Cache Llc;
  LlcDoor ToLlc;
  std::vector<std::unique_ptr<Cache>> Slices; ///< by cluster
  uint32_t L2HitCycles;
};

} // namespace vorion::isasim
