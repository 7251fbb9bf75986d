/// The clock: what a machine's runs take (docs/adr/0007-the-clock.md).
#pragma once

#include "core/HostBudget.h"
#include "raster/WorkLog.h"
#include "timing/common/TimeObserver.h"
#include "timing/common/Turns.h"
#include "timing/core/CoreClock.h"
#include "timing/core/InstructionCache.h"
#include "timing/host/HostUnits.h"
#include "timing/raster/PixelClock.h"
#include "timing/raster/RasterClock.h"
#include "vorion/isasim/Config.h"

#include <memory>
#include <optional>
#include <vector>

namespace vorion::isasim {

/// Reads the traces of the cores and the logs of the rasterizers. All calls
/// come one at a time, while all cores are parked, but for take(). Caches, DRAM
/// and time go on from run to run, and so do rasterizers and pixel units: a run
/// ends with its cores, and what they have not waited for goes on in the next
/// one.
class Clock {
public:
  /// Keeps references to both.
  Clock(const Config &C, const HostBudget &Budget);
  Clock(const Clock &) = delete;
  Clock &operator=(const Clock &) = delete;
  ~Clock();

  /// Where warp \p Warp of core \p Core writes its trace.
  CoreTrace *trace(unsigned Core, unsigned Warp) {
    return Traces[size_t{Core} * Shape.WarpsPerCore + Warp].get();
  }
  /// A rasterizer or a pixel unit has executed \p Work. Those of different
  /// sockets and clusters may call at the same time.
  void expect(raster::CommandWork &&Work);
  void expect(raster::TailWork &&Work);
  /// A rasterizer has fetched these of a command that it has not executed yet.
  void expectPart(const raster::CommandWork &Begun,
                  std::vector<raster::GaussianWork> &&Fetched);
  /// Whether the budget has room for more of the rasterizer, or the pixel unit,
  /// of core \p Core, and of all; if not, take() makes room. It then guesses
  /// the order of requests, if need be.
  bool hasRoom(unsigned Core) const;
  bool hasRoomForTail(unsigned Core) const;
  bool hasRoom() const;

  /// Notifies \p Observers from now on, in this order.
  void setObservers(std::vector<TimeObserver *> Observers);

  /// \name Commands of the host, on a machine that has units for them
  /// Otherwise copies are number 0, and launches wait for nothing.
  /// @{
  uint64_t copies(const HostCopy &Copy, CommandOrder Order);
  /// Of the next run; without a call it waits for all commands before it.
  void orderLaunch(CommandOrder Order) { LaunchOrder = std::move(Order); }
  /// The number of the last command.
  uint64_t lastCommand() const { return Host ? Host->last() : 0; }
  /// Time goes on until all copies have ended: time of no run.
  void settle();
  /// @}

  /// A run of \p Code begins: it is launched when its command says so.
  void begin(const CodeTable &Code);
  /// The warps of core \p Core, as bits, that have ended. All cores are parked.
  void setEnded(unsigned Core, uint32_t Warps);
  /// What the cores have written is the clock's from now on.
  void publish();
  /// Whether enough has been published that take() is worth its while.
  bool isWorthTaking() const { return WorthTaking; }
  /// Takes what it can of what was published. May run while the cores write on.
  void take();
  /// Whether somebody watches, who is to be told on the thread of Machine::run.
  bool isWatched() const { return Watch.has_value(); }
  /// The run is over; all is taken. Nothing if the budget's time is over before
  /// that.
  std::optional<TimeReport> end();
  /// The rasterizers and pixel units were made anew: what they had is dropped.
  void reset();

private:
  void lastWork();
  uint64_t launch();
  template <typename Function> void goOnWithoutCores(Function IsDone);
  bool takeAll();
  bool step();
  bool stepMemory(Turn Next);
  void advanceMemory(uint64_t Until);
  void giveUp();
  void update(unsigned Who);
  void grant(unsigned Core, uint64_t Then);
  void arrive(unsigned Core, uint64_t Then);
  void fetchCode(unsigned Core, uint64_t Then);
  void arriveCode(unsigned Socket, const Answer &A);
  void stepRaster(unsigned Socket, uint64_t Then);
  void stepPixels(unsigned Cluster, uint64_t Then);
  void wake(unsigned Core, uint64_t Then);
  /// Places in AllTurns, by which memory knows the units, too.
  unsigned placeOfRaster(unsigned Socket) const {
    return static_cast<unsigned>(Cores.size()) + Socket;
  }
  unsigned placeOfPixels(unsigned Cluster) const {
    return static_cast<unsigned>(Cores.size() + Rasters.size()) + Cluster;
  }
  /// Of the command processor and the DMA engines, the last of AllTurns.
  unsigned placeOfHost() const {
    return placeOfPixels(static_cast<unsigned>(Pixels.size()));
  }
  /// By which memory knows instruction caches, which have no turns.
  unsigned placeOfCode(unsigned Socket) const {
    return placeOfPixels(static_cast<unsigned>(Pixels.size())) + Socket;
  }
  bool isOverfull() const;
  bool coresAreDone() const;
  uint64_t coresQuietAt() const;
  void collectActivities(TimeReport &R) const;
  void collectRasters(TimeReport &R) const;
  void collectTimes(TimeReport &R) const;

  const Config &Shape;
  const HostBudget &Budget;
  const TimingConfig &Timing;
  const MachineName Name;
  MemorySystem Memory;
  std::vector<std::unique_ptr<TraceBuffer>> Traces; ///< by core and warp
  std::vector<CoreClock> Cores;
  std::vector<InstructionCache> Codes; ///< by socket
  std::vector<RasterClock> Rasters;
  std::vector<PixelClock> Pixels; ///< by cluster
  std::optional<HostUnits> Host;
  std::optional<CommandOrder> LaunchOrder;
  uint64_t Launched = 0; ///< command of the run
  std::vector<OpInfo> Ops;
  std::vector<bool> Ended; ///< by core: all its warps have
  Turns AllTurns;          ///< of cores, rasterizers, pixel units, Host
  std::vector<Answer> Answers;
  struct Arrived {
    std::vector<std::pair<unsigned, unsigned>> Warps; ///< core and warp
  };
  std::vector<Arrived> Barriers;
  uint64_t Now = 0; ///< where the last run ended
  uint64_t Begun = 0;
  /// No rasterizer and no pixel unit goes beyond this in a run whose cores are
  /// done, nor beyond the cores.
  uint64_t Horizon = 0;
  uint64_t OutOfOrder = 0;
  bool WorthTaking = false;
  bool BetweenRuns = false; ///< there is nothing for cores to do
  std::optional<TimeWatch> Watch;
};

} // namespace vorion::isasim
