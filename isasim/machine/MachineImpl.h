#pragma once

/// What a machine is made of, and how a run goes on. Machine.cpp has the public
/// functions, Rounds.cpp a run's rounds.

#include "core/Core.h"
#include "core/HostBudget.h"
#include "core/Watch.h"
#include "machine/CodeCache.h"
#include "machine/HangDetector.h"
#include "machine/HostInterface.h"
#include "machine/RasterUnits.h"
#include "machine/WorkerPool.h"
#include "mem/Memory.h"
#include "timing/Clock.h"
#include "vorion/isasim/Machine.h"

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
        Raster(Shape, *Storage, [this] { return Budget.mustStop(); }),
        Host(*Storage, Budget,
             [this](std::string_view Text) { printOfHost(Text); }) {
    for (unsigned Id = 0; Id != Shape.cores(); ++Id)
      Cores.push_back(std::make_unique<Core>(Shape, Id));
    if (Shape.Timing.Enabled)
      Time = std::make_unique<Clock>(Shape, Budget);
    chooseLog();
  }

  void command(raster::CommandWork &&Work) override;
  void tail(raster::TailWork &&Work) override;
  bool wantsFetches() const override { return isClocked(); }
  void part(const raster::CommandWork &Begun,
            std::vector<raster::GaussianWork> &&Fetched) override;
  bool hasRoom(unsigned Core) const override {
    return !isClocked() || Time->hasRoom(Core);
  }
  bool hasRoomForTail(unsigned Core) const override {
    return !isClocked() || Time->hasRoomForTail(Core);
  }
  unsigned blockTests() const override {
    return isClocked() ? Shape.Timing.Raster.SkipBlocks : 0;
  }

  /// Calls Use(host address, offset, bytes) for the pieces of a range of
  /// global memory, the image or the stacks; false, and no call, if it is not
  /// all mapped.
  template <typename Function>
  bool access(uint32_t Address, uint64_t Bytes, Function Use) const;
  /// What the run of a launch, or without one of main, has of memory.
  RunMemory memoryFor(uint32_t LaunchBlock, const VxLaunch &Launch) const;
  void resetCores(uint32_t LaunchBlock, const VxLaunch &Launch);
  void runCores();
  void translate();
  void atSyncPoint();
  void executeParked(Core &C, WarpState &S);
  void arriveGlobally(WarpState &S);
  void runRasterizers();
  void flushConsole(bool All);
  void flushConsole(Core &Of, bool All);
  void printOfHost(std::string_view Text);
  bool findTrap(RunResult &R);
  bool decideEnd(RunResult &R);
  void count(RunResult &R) const;
  bool isObserved() const { return !Watcher.Observers.empty(); }
  uint64_t retired() const;
  const ExecTable &exec() const;
  void chooseLog();
  void resetRasterizers();
  void publishTime();
  void takeTime();
  bool makeRoomInTime();
  void endTime(RunResult &R);
  bool isClocked() const { return Time && Mode != Clocking::Off; }
  void tellTimeObservers();

  const Config Shape;
  HostBudget Budget;
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
