/// How long a core takes: an in-order pipeline with one warp, whose numbers are
/// timing.core of the configuration.
#pragma once

#include "timing/LineWaits.h"
#include "timing/OpClass.h"
#include "timing/TraceWriter.h"
#include "timing/Turn.h"

#include <array>
#include <vector>

namespace vorion::isasim {

/// Reads a core's trace. Everything between two requests that others can notice
/// is done by advance(); the request itself is done by its owner's turn in the
/// order of time (Clock.h).
class CoreClock {
public:
  CoreClock(const CoreTiming &Params, MemoryPort ToMemory, TraceBuffer &Trace);

  /// A run of the program \p Ops begins at \p Now.
  void begin(const std::vector<OpInfo> &Ops, uint64_t Now);

  enum class State : uint8_t {
    Starved, ///< the trace is used up
    Access,  ///< wants memory, or a place among the accesses in flight
    Answer,  ///< needs what memory has not answered
    Barrier, ///< arrives at a barrier
    RasterStart,
    RasterWait,
    RasterTake,
  };
  /// Goes on to the next request, or to the trace's end.
  void advance();

  State state() const { return Now; }
  /// Whether its request had to wait: until resume().
  bool isBlocked() const { return Blocked; }
  /// When it makes its request; never while that has to wait.
  Turn turn() const {
    if (Blocked || Now == State::Answer)
      return Turn();
    return Now == State::Starved ? Turn(Next, false) : Turn(At);
  }
  /// How much trace is waiting.
  size_t backlog() const { return Trace.size(); }

  /// Makes the access of State::Access, if there is a place for it. Otherwise
  /// its turn is now when one will be free. Returns whether it did.
  bool access(MemorySystem &Memory);
  /// An answer of memory. Goes on, if it was what the core needed.
  void answer(uint32_t Tag, uint64_t Then);
  uint32_t barrier() const { return Words[0]; }
  uint32_t barrierCount() const { return Words[1]; }
  /// The request of any other state has been granted at \p Then, which is not
  /// before its turn; what lies between is for \p Why.
  void resume(uint64_t Then, CoreCycle Why);
  /// It has not.
  void block() { Blocked = true; }

  /// When its last access is done; Turn::Never if that is not known yet.
  uint64_t quietAt() const;
  /// The run ended at \p End: what is left was waiting for others.
  void end(uint64_t End) { spend(CoreCycle::Ended, End - Next); }

  const CoreTime &time() const { return Spent; }
  /// Warp and lane instructions by class.
  struct ClassCount {
    uint64_t Warp = 0, Lane = 0;
  };
  const std::array<ClassCount, size_t(OpClass::Count)> &classes() const {
    return Classes;
  }
  uint64_t linesRequested() const { return LinesRequested; }
  uint64_t localConflicts() const { return LocalConflicts; }

private:
  void spend(CoreCycle What, uint64_t Cycles) {
    Spent.Cycles[size_t(What)] += Cycles;
    Next += Cycles;
  }
  void waitUntil(uint64_t Then, CoreCycle Why) {
    if (Then > Next)
      spend(Why, Then - Next);
  }
  void startRun(const RunRecord &R);
  bool waitForOperands(const OpInfo &O);
  bool waitUntilQuiet();
  void waitForUnit(const OpInfo &O) {
    waitUntil(UnitFree[size_t(O.On)], CoreCycle::Unit);
  }
  /// Whether an access needs a place among those in flight.
  bool needsPlace(const OpInfo &O, AccessWord A) const {
    return P.LoadsQueue ? O.Class != OpClass::Store : A.Lines != 0;
  }
  uint64_t beginOnUnit(const OpInfo &O);
  void fetchNext(const OpInfo &O, uint64_t Begun);
  void issue(const OpInfo &O);
  void finish(const OpInfo &O);
  template <bool Ideal> void advanceThrough();
  template <bool Ideal> bool advanceOne(const OpInfo &O);
  bool advanceParked(const OpInfo &O);
  uint64_t localAccess(const OpInfo &O, AccessWord A);
  void setLoaded(const OpInfo &O, uint64_t Done);
  void setReady(unsigned Register, uint64_t Then, CoreCycle Why);

  const CoreTiming P;
  /// Whether the front end always has the next instruction, but behind a branch
  /// or a change of lanes, and nobody waits in front of a unit. Then none of
  /// that is looked at.
  const bool IsIdeal;
  TraceBuffer &Trace;
  const std::vector<OpInfo> *Ops = nullptr;

  State Now = State::Starved;
  bool Blocked = false;
  uint64_t Next = 0; ///< the earliest next issue; all before is accounted for
  uint64_t At = 0;
  uint32_t Words[2] = {};
  const OpInfo *Waiting = nullptr; ///< instruction of the request

  unsigned Position = 0; ///< in the front run
  bool InRun = false;    ///< the front run has been started
  uint32_t Expected = 0; ///< instruction behind the last run
  uint16_t LastMask = 1;
  unsigned Lanes = 1;
  OpClass LastClass = OpClass::Alu;

  /// Turn::Never while it is not known.
  std::array<uint64_t, NumRegisters> Ready{};
  std::array<CoreCycle, NumRegisters> ReadyWhy{};
  uint64_t Fetched = 0; ///< when the next instruction can issue at the earliest
  CoreCycle FetchWhy = CoreCycle::Fetch;

  std::array<uint64_t, size_t(Port::Count)> UnitFree{};
  /// Of a unit whose instructions wait in front of it: when the last ones
  /// begin, in a ring.
  struct UnitQueue {
    std::vector<uint64_t> Begins;
    size_t Next = 0;
  };
  std::array<UnitQueue, size_t(Port::Count)> Queues;
  /// When the places of a unit that operations keep (OpInfo::Hold) are free.
  std::array<std::vector<uint64_t>, size_t(Port::Count)> Places;
  /// A set of lines for each place, and behind these one for all accesses that
  /// need none.
  LineWaits InFlight;
  std::vector<const OpInfo *> Accesses; ///< by place
  uint64_t LastDone = 0; ///< of the accesses to memory whose end is known

  CoreTime Spent;
  std::array<ClassCount, size_t(OpClass::Count)> Classes{};
  uint64_t LinesRequested = 0, LocalConflicts = 0;
};

} // namespace vorion::isasim
