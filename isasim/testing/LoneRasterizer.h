/// A rasterizer by itself, with an agent and memory: what a command does, and
/// how long the clock says that it takes where memory answers after a fixed
/// time. For tools that compare it with other rasterizers.
#pragma once

#include "raster/Rasterizer.h"
#include "timing/raster/RasterClock.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace vorion::isasim {

/// All of a rasterizer's memory, from address 0.
class LoneMemory : public raster::RasterMemory {
public:
  explicit LoneMemory(size_t Bytes) : Lines(Bytes / sizeof(Line) + 1) {}
  std::byte *range(uint32_t Address, uint64_t Bytes) override {
    return Address + Bytes > Lines.size() * sizeof(Line)
               ? nullptr
               : reinterpret_cast<std::byte *>(Lines.data()) + Address;
  }

private:
  struct alignas(64) Line {
    std::array<std::byte, 64> Bytes;
  };
  std::vector<Line> Lines;
};

class LoneRasterizer {
public:
  explicit LoneRasterizer(raster::RasterMemory &Memory)
      : Unit(Memory, {&Agent}) {
    Unit.setLog(&Told);
  }
  void set(raster::Csr C, uint32_t Value) {
    Agent.write(C, std::span(&Value, 1), 1);
  }
  /// Executes the bank as a command; returns what was done.
  raster::CommandWork run() {
    set(raster::Csr::Start, 1);
    Unit.finish(Agent);
    return std::move(Told.Work);
  }

private:
  class Log : public raster::WorkLog {
  public:
    void command(raster::CommandWork &&Done) override {
      Earlier.insert(Earlier.end(), Done.Gaussians.begin(),
                     Done.Gaussians.end());
      Done.Gaussians = std::exchange(Earlier, {});
      Work = std::move(Done);
    }
    void tail(raster::TailWork &&) override {}
    bool wantsFetches() const override { return true; }
    void part(const raster::CommandWork &,
              std::vector<raster::GaussianWork> &&Fetched) override {
      Earlier.insert(Earlier.end(), Fetched.begin(), Fetched.end());
    }
    raster::CommandWork Work; ///< the last, with all of its Gaussians

  private:
    std::vector<raster::GaussianWork> Earlier;
  };

  raster::RasterAgent Agent;
  raster::Rasterizer Unit;
  Log Told;
};

/// The clock's time of a command whose reads take \p Latency cycles.
inline RasterTime timeAlone(raster::CommandWork &&Work, uint32_t Latency) {
  TimingConfig P;
  P.L2.FixedCycles = Latency;
  MemorySystem M(P, 1);
  RasterClock Clock(P, MemoryPort(), 1, 4);
  Clock.begin(0);
  Clock.expect(0, std::move(Work));
  Clock.start(0, 0);
  while (Clock.turn().At != Turn::Never)
    Clock.step(M);
  Clock.end(Clock.freeAt());
  return Clock.time();
}

} // namespace vorion::isasim
