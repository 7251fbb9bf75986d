/// How long a pixel unit takes: lanes that hold a pixel each and go through the
/// rest of a list.
#pragma once

#include "raster/WorkLog.h"
#include "timing/common/CycleLedger.h"
#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/memory/MemorySystem.h"
#include "timing/raster/GaussianFetch.h"

#include <cstddef>
#include <deque>
#include <limits>
#include <optional>
#include <span>
#include <vector>

namespace vorion::isasim {

/// One pixel unit. Its owner calls step() in the order of time. Open pixels are
/// taken in groups of as many as there are lanes; a group ends with the pixel
/// that examines most. Gaussians that do not all fit the buffer are fetched
/// again for every group.
class PixelClock {
public:
  /// \p MostHeld: bytes of hand-overs that it may hold for want of time.
  PixelClock(const TimingConfig &Params, MemoryPort Port, unsigned Cores,
             size_t MostHeld = std::numeric_limits<size_t>::max());

  /// The work of a hand-over of core \p Core of the cluster.
  void expect(unsigned Core, raster::TailWork &&Executed);
  /// False if it must go on before it is told of others.
  bool hasRoom() const { return Held < MostHeld; }
  /// Notifies \p Observers from now on, as of number \p Own; null for none.
  void watch(const TimeWatch *Observers, unsigned Own);

  /// A run begins; what was given to it before goes on.
  void begin(uint64_t Now);
  /// No more work will be known in this run.
  void lastWork() { MoreWork = false; }
  /// Behind lastWork(): more work may be known.
  void moreWork() { MoreWork = true; }
  /// Everything that it was given is dropped.
  void reset();
  /// The next expected hand-over of \p Core has reached the queue.
  void accept(unsigned Core, uint64_t Now);

  /// What it does next is not known as long as its work is not.
  Turn turn() const {
    return Turn(At, Now != Stage::Take || !MoreWork ||
                        !Expected[Queue.front()].empty());
  }
  /// Does it; returns the core of a hand-over that is done with it.
  std::optional<unsigned> step(MemorySystem &Memory);
  /// An answer of memory.
  void answer(const Answer &A);

  uint64_t freeAt() const { return DoneAt; }
  void end(uint64_t End);
  const PixelTime &time() const { return Spent; }

private:
  enum class Stage : uint8_t {
    Idle,
    Take,
    Record, ///< the hand-over's record has come
    Group,  ///< the next group's pixels have come
    Fetch,
    Store, ///< the group's pixels are written
    Empty, ///< waits for the last of them to be taken
    Done
  };

  void spend(PixelCycle What, uint64_t Cycles) {
    DoneAt += Cycles;
    Ledger.spend(What, DoneAt);
  }
  /// Waits until \p Then for what came as \p Came says; the cycles that are not
  /// the link's are for \p Why.
  void waitFor(uint64_t Then, const Arrival &Came, PixelCycle Why) {
    Came.divide(DoneAt, Then, [&](bool IsLink, uint64_t End) {
      spend(IsLink ? PixelCycle::Link : Why, End - DoneAt);
    });
  }
  void take(MemorySystem &Memory);
  void recorded(MemorySystem &Memory);
  void nextGroup();
  void startGroup(MemorySystem &Memory);
  void fetch(MemorySystem &Memory);
  void fetched();
  void storeGroup(MemorySystem &Memory);
  void stored();
  PixelCycle rest() const;
  void pixelLines(MemorySystem &Memory, unsigned Set, size_t Group, CacheOp Op);
  static unsigned pixelSet(size_t Group) {
    return Group % 2 ? GaussianFetch::OddOthers : GaussianFetch::EvenOthers;
  }
  std::span<const raster::TailWork::OpenPixel> pixelsOf(size_t Group) const;
  size_t groups() const {
    return (Work.Pixels.size() + Timing.Lanes - 1) / Timing.Lanes;
  }

  const PixelTiming Timing;
  const size_t MostHeld;
  size_t Held = 0;                                    ///< bytes
  bool MoreWork = true;                               ///< see lastWork()
  std::vector<std::deque<raster::TailWork>> Expected; ///< by core
  std::deque<unsigned> Queue;                         ///< cores

  Stage Now = Stage::Idle;
  uint64_t At = Turn::Never;
  uint64_t DoneAt = 0; ///< all cycles before are accounted for
  unsigned Serving = 0;
  raster::TailWork Work;
  uint64_t TakenAt = 0; ///< of Work
  size_t Group = 0;
  uint32_t Visits = 0;    ///< Gaussians that the group examines
  uint32_t Number = 0;    ///< of them, asked for
  uint32_t Evaluated = 0; ///< of these, given to lanes
  GaussianFetch Fetch;
  CycleLedger<PixelCycle> Ledger;
  PixelTime Spent;
  const TimeWatch *Watch = nullptr;
};

} // namespace vorion::isasim
