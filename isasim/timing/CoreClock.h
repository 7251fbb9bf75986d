/// How long a core takes: a 5-stage in-order pipeline with one warp.
#pragma once

#include "timing/MemorySystem.h"
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
  CoreClock(const CoreTiming &Params, unsigned Cluster, TraceBuffer &Trace)
      : P(Params), Cluster(Cluster), Trace(Trace) {}

  /// A run of the program \p Ops begins at \p Now.
  void begin(const std::vector<OpInfo> &Ops, uint64_t Now);

  enum class State : uint8_t {
    Starved, ///< the trace is used up
    Access,  ///< wants memory
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
    if (Blocked)
      return Turn();
    return Now == State::Starved ? Turn(Next, false) : Turn(At);
  }
  /// How much trace is waiting.
  size_t backlog() const { return Trace.size(); }

  /// Makes the access of State::Access.
  void access(MemorySystem &Memory);
  uint32_t barrier() const { return Words[0]; }
  uint32_t barrierCount() const { return Words[1]; }
  /// The request of any other state has been granted at \p Then, which is not
  /// before its turn; what lies between is for \p Why.
  void resume(uint64_t Then, CoreCycle Why);
  /// It has not.
  void block() { Blocked = true; }

  /// When its last access is done.
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
  void waitForOperands(const OpInfo &O);
  void waitForLsu();
  void issue(const OpInfo &O);
  bool advanceOne(const OpInfo &O);
  bool advanceParked(const RunRecord &R);
  void localAccess(const OpInfo &O, AccessWord A);
  void setReady(unsigned Register, uint64_t Then, CoreCycle Why);

  const CoreTiming P;
  unsigned Cluster;
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

  std::array<uint64_t, NumRegisters> Ready{};
  std::array<CoreCycle, NumRegisters> ReadyWhy{};
  std::array<uint64_t, size_t(Unit::Count)> UnitFree{};
  std::vector<uint64_t> InFlight; ///< when accesses will be done

  CoreTime Spent;
  std::array<ClassCount, size_t(OpClass::Count)> Classes{};
  uint64_t LinesRequested = 0, LocalConflicts = 0;
};

} // namespace vorion::isasim
