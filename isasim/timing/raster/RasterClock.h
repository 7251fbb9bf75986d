/// How long a rasterizer takes: the commands in its queues, one after the
/// other, from fetching Gaussians (GaussianFetch.h) over the lanes
/// (RasterLanes.h) to writing the tile (TileStore.h).
#pragma once

#include "raster/RasterAgent.h"
#include "raster/WorkLog.h"
#include "timing/common/CycleLedger.h"
#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/memory/MemorySystem.h"
#include "timing/raster/GaussianFetch.h"
#include "timing/raster/RasterLanes.h"
#include "timing/raster/TileStore.h"

#include <cassert>
#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

namespace vorion::isasim {

/// What the clock knows of a rasterizer command. Its Gaussians may arrive in
/// parts while the first ones are timed.
class RasterWork {
public:
  RasterWork() = default;
  /// Nothing is known but Core, What, Entries and First.
  explicit RasterWork(const raster::CommandWork &Begun) {
    Of.Core = Begun.Core;
    Of.What = Begun.What;
    Of.Entries = Begun.Entries;
    Of.First = Begun.First;
  }

  /// The rest is known. Of \p Done, but its Gaussians.
  void complete(raster::CommandWork &&Done) {
    add(std::exchange(Done.Gaussians, {}));
    Of = std::move(Done);
    Complete = true;
  }
  /// The next Gaussians, in the order of the fetches.
  void add(std::vector<raster::GaussianWork> &&More) {
    if (More.empty())
      return;
    const size_t First = known();
    Parts.push_back({First, std::move(More)});
  }
  /// Gaussians before \p Number are not asked for again. Returns how many are
  /// forgotten.
  size_t drop(size_t Number) {
    const size_t Before = Dropped;
    while (!Parts.empty() && Parts.front().end() <= Number) {
      Dropped = Parts.front().end();
      Parts.pop_front();
    }
    return Dropped - Before;
  }

  const raster::CommandWork &command() const { return Of; }
  /// Whether all is known: command() as well.
  bool isComplete() const { return Complete; }
  /// Gaussians that are.
  size_t known() const { return Parts.empty() ? Dropped : Parts.back().end(); }
  /// One that has not been dropped.
  const raster::GaussianWork &operator[](size_t Number) const {
    assert(Number < known());
    auto Part = Parts.begin();
    while (Part->end() <= Number)
      ++Part;
    return Part->Gaussians[Number - Part->First];
  }
  /// The command, which is not asked for again.
  raster::CommandWork take() { return std::move(Of); }

private:
  struct Part {
    size_t First;
    std::vector<raster::GaussianWork> Gaussians;
    size_t end() const { return First + Gaussians.size(); }
  };
  raster::CommandWork Of;
  std::deque<Part> Parts;
  size_t Dropped = 0;
  bool Complete = false;
};

/// One rasterizer. Its owner calls step() in the order of time.
class RasterClock {
public:
  /// \p MostHeld: bytes of commands that it may hold for want of time.
  RasterClock(const TimingConfig &Params, MemoryPort Port, unsigned Agents,
              unsigned QueueDepth,
              size_t MostHeld = std::numeric_limits<size_t>::max());

  /// Batches that an agent holds (raster::AgentConfig).
  static constexpr unsigned BatchDepth = raster::AgentConfig().BatchDepth;

  /// The work of a command of an agent. A command may have been started before
  /// it is known: while the machine's rasterizer is halted by an agent's
  /// batches, it executes no other command.
  void expect(unsigned Agent, raster::CommandWork &&Executed);
  /// The next Gaussians of a command, \p Begun, that is being executed.
  void expectPart(unsigned Agent, const raster::CommandWork &Begun,
                  std::vector<raster::GaussianWork> &&Fetched);
  /// False if it holds so much that it must go on before it is told more. It
  /// then takes commands out of turn that it knows, rather than wait for one
  /// that it does not know.
  bool hasRoom() const { return Held < MostHeld; }
  /// How often it did, in this run.
  uint64_t outOfTurn() const { return OutOfTurn; }
  /// To be called before turn() when it may have been told something.
  void refresh();

  /// Notifies \p Observers from now on, as of number \p Own; null for none.
  void watch(const TimeWatch *Observers, unsigned Own);

  /// A run begins; what was given to it before goes on.
  void begin(uint64_t Now);
  /// No more work will be known in this run: what has none yet waits for the
  /// next run and is passed over.
  void lastWork() { MoreWork = false; }
  /// Behind lastWork(): more work may be known from \p Now on.
  void moreWork(uint64_t Now);
  /// Everything that it was given is dropped.
  void reset();
  bool isFull(unsigned Agent) const {
    return Agents[Agent].Queued >= QueueDepth;
  }
  bool isBusy(unsigned Agent) const {
    return Agents[Agent].Queued != 0 || Agents[Agent].Tails != 0;
  }
  /// The agent's core starts its next command; needs !isFull().
  void start(unsigned Agent, uint64_t Now);

  /// Whether a batch, or the end of a command that hands over, waits for the
  /// agent's core, or nothing will come.
  bool canTake(unsigned Agent) const {
    return !Agents[Agent].Batches.empty() || Agents[Agent].Queued == 0;
  }
  /// The core takes it; needs canTake().
  void takeBatch(unsigned Agent, uint64_t Now);

  /// What it does next is not known as long as its work is not.
  Turn turn() const {
    const Turn Front = turnOfFront();
    return Behind && Turn(Behind->At) < Front ? Turn(Behind->At) : Front;
  }
  struct Finished {
    unsigned Agent;
    bool HandedOver; ///< the pixel unit goes on
    uint64_t At;     ///< the command was done with it, all cycles counted
  };
  /// Does it, if it is known; returns the agent of a command that is
  /// done with it, or has a batch of gradients.
  std::optional<Finished> step(MemorySystem &Memory);
  /// An answer of memory.
  void answer(const Answer &A);
  /// The pixel unit is done with a command of the agent.
  void tailDone(unsigned Agent) { --Agents[Agent].Tails; }

  /// When it was done with all that it was given.
  uint64_t freeAt() const { return DispatchAt; }
  /// Commands that it or the pixel unit is not done with.
  uint64_t commandsLeft() const;
  /// The run ended at \p End.
  void end(uint64_t End);
  const RasterTime &time() const { return Spent; }
  /// What its lanes and its pixel buffer did.
  const LaneWork &laneWork() const { return OfLanes; }

private:
  struct Agent {
    std::deque<RasterWork> Expected;
    unsigned Queued = 0;
    unsigned Behind = 0; ///< of these, whose tile is written behind the next
    unsigned Tails = 0;  ///< that the pixel unit has
    /// Waiting for the core; false for the end of a command.
    std::deque<bool> Batches;
    unsigned Waiting = 0; ///< of these, batches

    bool hasCommand() const { return Queued != Behind; }
  };
  /// A tile that is written while others are blended.
  struct Written {
    raster::CommandWork Work;
    unsigned Agent;
    uint64_t TakenAt, At;
    TileStore::Place Next;
  };
  enum class Stage : uint8_t {
    Idle,
    Take,
    Fetch,
    HandOver,
    Full, ///< the tile can be written when the one behind has been
    Drain,
    Done
  };

  void spend(RasterCycle What, uint64_t Cycles) {
    DispatchAt += Cycles;
    Ledger.spend(What, DispatchAt);
  }
  /// Waits until \p Then for what came as \p Came says; the cycles that are not
  /// the link's are for \p Why.
  void waitFor(uint64_t Then, const Arrival &Came, RasterCycle Why) {
    Came.divide(DispatchAt, Then, [&](bool IsLink, uint64_t End) {
      spend(IsLink ? RasterCycle::Link : Why, End - DispatchAt);
    });
  }
  Turn turnOfFront() const {
    if (Now == Stage::Fetch && Number == Work.known() && !Work.isComplete())
      return MoreWork ? Turn(At, false) : Turn();
    if (Now != Stage::Take)
      return Turn(At);
    const std::optional<unsigned> Next = nextAgent();
    return Next ? Turn(At, !Agents[*Next].Expected.empty()) : Turn();
  }
  const raster::Job &task() const { return Work.command().What; }
  RasterWork &known(unsigned Agent, const raster::CommandWork &Begun);
  std::optional<unsigned> nextAgent() const;
  bool mustWaitForBehind() const;
  void take();
  void countBlends();
  void load(MemorySystem &Memory);
  uint32_t entryOf(size_t Gaussian) const;
  void handOver();
  void awaitRoom();
  void countFragments(unsigned More);
  void fetch(MemorySystem &Memory);
  void fetched();
  bool endsBatch(size_t Gaussian) const;
  void dispatch(const raster::GaussianWork &G);
  void flush();
  bool fitsBuffer(const raster::Job &J) const;
  void drainBehind();
  void drain(MemorySystem &Memory);
  void drained();
  void writeBehind(MemorySystem &Memory);
  void writtenBehind();
  Finished finishBehind(MemorySystem &Memory);
  Finished finish(MemorySystem &Memory);
  Finished complete(const raster::CommandWork &Of, unsigned Agent,
                    uint64_t TakenAt, uint64_t Then);
  void goOn();

  const RasterTiming Timing;
  unsigned QueueDepth;
  const size_t MostHeld;
  size_t Held = 0; ///< bytes
  uint64_t OutOfTurn = 0;
  std::vector<Agent> Agents;
  unsigned NextAgent = 0, Serving = 0;
  bool MoreWork = true; ///< see lastWork()

  Stage Now = Stage::Idle;
  uint64_t At = Turn::Never;
  /// The next cycle in which dispatch can give pixels to lanes. All cycles
  /// before are accounted for.
  uint64_t DispatchAt = 0;
  RasterWork Work;
  bool BlendsCounted = false; ///< of Work
  uint64_t TakenAt = 0;       ///< of Work
  size_t Number = 0;          ///< of the Gaussian that is fetched next
  size_t Dispatches = 0; ///< Gaussians that have been dispatched or dropped
  size_t HandedOver = 0; ///< of these, in batches that the agent has
  /// Fragments that fill no batch yet, and batches that the agent has not.
  unsigned Fragments = 0, DueBatches = 0;
  bool IsStarved = false; ///< see refresh()
  /// When the last box of Work had its last lane; 0 if there was none.
  uint64_t BlendedAt = 0;
  GaussianFetch Fetch;
  RasterLanes Lanes;
  const TileStore Store;
  TileStore::Place Draining;
  std::optional<Written> Behind;
  /// Whether the buffer holds what no writing of a tile has cleared.
  bool IsDirty = true;

  CycleLedger<RasterCycle> Ledger;
  RasterTime Spent;
  LaneWork OfLanes;
  const TimeWatch *Watch = nullptr;
};

} // namespace vorion::isasim
