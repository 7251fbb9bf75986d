#pragma once

/// What a machine is made of, and how a run goes on. Machine.cpp has the public
/// functions, Rounds.cpp a run's rounds.

#include "core/Core.h"
#include "core/Watch.h"
#include "machine/CodeCache.h"
#include "machine/HangDetector.h"
#include "machine/HostInterface.h"
#include "machine/RasterUnits.h"
#include "machine/WorkerPool.h"
#include "mem/Memory.h"
#include "timing/Clock.h"
#include "vorion/isasim/Machine.h"

#include <atomic>
#include <chrono>
#include <cstdio>

namespace vorion::isasim {

/// Whether the translator was asked for by name.
bool isTranslatorWanted(Engine E);

/// The host's vector unit that an engine translates for.
VectorUnit unitOf(Engine E);

struct Machine::Impl final : raster::WorkLog {
  Impl(const Config &C, std::unique_ptr<Memory> Mem)
      : Shape(C), Storage(std::move(Mem)),
        Programs(isTranslatorWanted(C.Runs) ? 0 : Translator::UsualCost,
                 unitOf(C.Runs)),
        Pool(C.HostThreads),
        Raster(Shape, *Storage, [this] { return mustStop(); }),
        Host(*Storage, [this](char Byte) { Cores[0]->print(Byte); }) {
    for (unsigned Id = 0; Id != Shape.cores(); ++Id)
      Cores.push_back(std::make_unique<Core>(Shape, Id));
    if (Shape.Timing.Enabled)
      Time = std::make_unique<Clock>(Shape);
    chooseLog();
  }

  void command(raster::CommandWork &&Work) override;
  void tail(raster::TailWork &&Work) override;
  unsigned blockTests() const override {
    return isClocked() ? Shape.Timing.Raster.SkipBlocks : 0;
  }

  /// Calls Use(host address, offset, bytes) for the pieces of a range of
  /// global memory, the image or the stacks; false, and no call, if it is not
  /// all mapped.
  template <typename Function>
  bool access(uint32_t Address, uint64_t Bytes, Function Use) const;
  void resetCores(uint32_t LaunchBlock, const VxLaunch &Launch);
  void runCores();
  void translate();
  void atSyncPoint();
  void executeParked(Core &C, WarpState &S);
  void arriveGlobally(WarpState &S);
  void flushConsole(bool All);
  bool findTrap(RunResult &R);
  bool decideEnd(RunResult &R);
  void count(RunResult &R) const;
  bool isObserved() const { return !Watcher.Observers.empty(); }
  double secondsSoFar() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() -
                                         Begin)
        .count();
  }
  bool stopRequested() const {
    return StopRequested.load(std::memory_order_relaxed);
  }
  bool watchdogExpired() const {
    return WatchdogSeconds > 0 && secondsSoFar() > WatchdogSeconds;
  }
  bool mustStop() const {
    return Running && (stopRequested() || watchdogExpired());
  }
  uint64_t retired() const;
  const ExecTable &exec() const;
  void chooseLog();
  void resetRasterizers();
  void takeTime();
  bool isClocked() const { return Time && Mode != Clocking::Off; }
  void tellTimeObservers();

  const Config Shape;
  std::unique_ptr<Memory> Storage;
  std::shared_ptr<const Image> Program;
  CodeCache Programs;
  CachedCode *Present = nullptr; ///< of the present run or the last one
  std::vector<std::unique_ptr<Core>> Cores;
  WorkerPool Pool;
  RasterUnits Raster;
  HostInterface Host;
  HangDetector Hang;
  Watch Watcher;
  double WatchdogSeconds = 0;
  std::chrono::steady_clock::time_point Begin; ///< of the run
  std::atomic<bool> StopRequested = false;
  bool Running = false;        ///< between the run's beginning and its end
  std::unique_ptr<Clock> Time; ///< if Shape.Timing.Enabled
  Clocking Mode = Clocking::On;
  std::vector<TimeObserver *> TimeObservers;
  std::function<void(std::string_view)> Console = [](std::string_view Text) {
    std::fwrite(Text.data(), 1, Text.size(), stdout);
    std::fflush(stdout);
  };
  std::vector<uint32_t> GlobalArrived; ///< by barrier
  uint64_t LastRound = 0;              ///< warp instructions
  bool Progress = false;               ///< see HangDetector
};

template <typename Function>
bool Machine::Impl::access(uint32_t Address, uint64_t Bytes,
                           Function Use) const {
  if (std::byte *At = Storage->shared(Address, Bytes)) {
    if (Bytes)
      Use(At, 0, Bytes);
    return true;
  }
  if (Bytes == 0 || Bytes > UINT32_MAX || !Storage->stackByte(Address) ||
      !Storage->stackByte(static_cast<uint32_t>(Address + Bytes - 1)))
    return false;
  for (uint32_t N = 0; N != Bytes; ++N)
    Use(Storage->stackByte(Address + N), N, 1);
  return true;
}

} // namespace vorion::isasim
