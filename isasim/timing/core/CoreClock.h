/// How long a core takes: an in-order pipeline whose numbers are timing.core of
/// the configuration.
#pragma once

#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/core/OpClass.h"
#include "timing/memory/LineWaits.h"
#include "timing/trace/TraceWriter.h"
#include "vorion/isasim/Timing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace vorion::isasim {

/// The tags of a core's data cache: they change time, never function. Loads
/// allocate, stores write through without allocating. Not coherent: it is
/// invalidated when a run begins.
class DataCache {
public:
  /// None if \p Kib is 0.
  DataCache(uint32_t Kib, uint32_t WaysIn)
      : Ways(WaysIn), Sets(Kib * 1024 / TimingLineBytes / WaysIn),
        Lines(size_t{Sets} * Ways) {}

  bool exists() const { return Sets != 0; }
  void clear() { std::fill(Lines.begin(), Lines.end(), Line()); }

  struct Line {
    uint32_t Tag = 0; ///< line number plus 1, 0 for none
    uint64_t Used = 0;
    uint64_t ReadyAt = 0; ///< when it was or will be there
    /// Writes to memory that it has seen (LineWriters::count()).
    uint64_t Writes = 0;
  };
  /// The line of \p Address, or nullptr.
  const Line *find(uint32_t Address) {
    const uint32_t Number = Address / TimingLineBytes;
    Line *Set = setOf(Number);
    for (uint32_t W = 0; W != Ways; ++W)
      if (Set[W].Tag == Number + 1) {
        Set[W].Used = ++Uses;
        return &Set[W];
      }
    return nullptr;
  }

  /// The line of \p Address comes at \p ReadyAt with the first \p Writes
  /// writes in it, in the place of the least recently used one.
  void fill(uint32_t Address, uint64_t ReadyAt, uint64_t Writes) {
    const uint32_t Number = Address / TimingLineBytes;
    Line *Set = setOf(Number);
    *std::min_element(Set, Set + Ways, [](const Line &A, const Line &B) {
      return A.Used < B.Used;
    }) = {Number + 1, ++Uses, ReadyAt, Writes};
  }

private:
  Line *setOf(uint32_t Number) { return &Lines[size_t{Number % Sets} * Ways]; }

  uint32_t Ways, Sets;
  std::vector<Line> Lines;
  uint64_t Uses = 0;
};

/// The banks of a data cache. A bank accepts one line per cycle. Stores and
/// misses wait in a queue behind their bank for the core's port, which sends
/// one line per cycle; a bank whose queue is full accepts nothing.
class DataCacheBanks {
public:
  DataCacheBanks(uint32_t BanksIn, uint32_t QueueIn)
      : Banks(BanksIn), Queue(QueueIn) {}

  bool exist() const { return Banks != 0; }
  void clear() {
    FreeAt.assign(Banks, 0);
    Leaves.assign(size_t{Banks} * Queue, 0);
    Oldest.assign(Banks, 0);
    PortAt = 0;
  }
  /// When its bank accepts the line of \p Address, which arrives at \p Now.
  uint64_t accept(uint32_t Address, uint64_t Now) {
    const uint32_t Bank = bankOf(Address);
    uint64_t At = std::max(Now, FreeAt[Bank]);
    if (Queue)
      At = std::max(At, Leaves[Bank * Queue + Oldest[Bank]]);
    FreeAt[Bank] = At + 1;
    return At;
  }
  /// When the port sends the line of \p Address, which its bank has processed
  /// at \p Now.
  uint64_t send(uint32_t Address, uint64_t Now) {
    const uint32_t Bank = bankOf(Address);
    const uint64_t At = std::max(Now, PortAt);
    PortAt = At + 1;
    if (Queue) {
      Leaves[Bank * Queue + Oldest[Bank]] = At;
      Oldest[Bank] = Oldest[Bank] + 1 == Queue ? 0 : Oldest[Bank] + 1;
    }
    return At;
  }

private:
  uint32_t bankOf(uint32_t Address) const {
    return Address / TimingLineBytes % Banks;
  }
  uint32_t Banks, Queue;
  std::vector<uint64_t> FreeAt; ///< by bank
  std::vector<uint64_t> Leaves; ///< by bank, a ring of the last that leave
  std::vector<uint32_t> Oldest; ///< by bank, in its ring
  uint64_t PortAt = 0;
};

/// What a core knows of one of its warps.
struct WarpTime {
  enum class State : uint8_t {
    Starved, ///< the trace is used up, or the next instruction was not seen
    Access,  ///< wants memory, or a place among the accesses in flight
    Answer,  ///< needs what memory has not answered
    Barrier, ///< arrives at a barrier of the device
    LocalBarrier, ///< has arrived at one of its core
    RasterStart,
    RasterWait,
    RasterTake,
    Fetch, ///< wants a line of its code from the instruction cache
    Step,  ///< of a core: an instruction that what others do may come before
  };

  TraceBuffer *Trace = nullptr;
  State Now = State::Starved;
  bool Blocked = false;
  bool Ended = false;           ///< it writes no more, unless it is spawned
  std::vector<uint64_t> Spawns; ///< when others have started it anew
  uint64_t At = 0;              ///< the request's time
  uint32_t Words[2] = {};
  const OpInfo *Waiting = nullptr; ///< instruction of the request

  unsigned Position = 0;   ///< in the front run
  bool InRun = false;      ///< the front run has been started
  uint32_t Expected = ~0U; ///< instruction behind the last run
  uint16_t LastMask = 1;
  unsigned Lanes = 1;
  OpClass LastClass = OpClass::Alu;

  /// Turn::Never while it is not known.
  std::array<uint64_t, NumRegisters> Ready{};
  std::array<CoreCycle, NumRegisters> ReadyWhy{};
  uint64_t Fetched = 0; ///< when the next instruction can issue at the earliest
  /// When it was decoded; before Fetched if it waits behind others. Only for
  /// holdDecoder().
  uint64_t Decoded = 0;
  CoreCycle FetchWhy = CoreCycle::Fetch;
  uint32_t CodeLine = NoLine; ///< of its last instruction

  /// The next instruction is decoded at \p Then at the earliest.
  void decodeNotBefore(uint64_t Then, CoreCycle Why) {
    Fetched = std::max(Fetched, Then);
    Decoded = Fetched;
    FetchWhy = Why;
  }

  static constexpr uint32_t NoLine = ~0U;
};

/// Reads a core's traces. Everything between two requests that others can
/// notice is done by advance(); the request itself is done by its owner's turn
/// in the order of time (Clock.h). It holds the state of the warp whose turn it
/// is, so that a core of one warp does not pay for others.
class CoreClock : private WarpTime {
public:
  using WarpTime::State;

  /// \p Traces by warp. \p AsksForCode: its code comes from an instruction
  /// cache, where not every fetch hits.
  CoreClock(const CoreTiming &Params, MemoryPort ToMemory,
            const std::vector<TraceBuffer *> &Traces, unsigned Barriers,
            bool AsksForCode);

  /// \p Observers are told from now on, as of number \p Own; null for nobody.
  void watch(const TimeWatch *Observers, unsigned Own) {
    Watch = Observers;
    Number = Own;
  }

  /// A run of the program \p Ops begins at \p Now. Its first word is the
  /// \p FirstWord th of its line.
  void begin(const std::vector<OpInfo> &Ops, uint32_t FirstWord, uint64_t Now);

  /// Goes on to the next request, or to the trace's end.
  void advance();

  State state() const { return IsAlone ? Now : Presented; }
  /// Whether no warp has anything left that is known.
  bool isIdle() const;
  /// When it makes its request; never while that has to wait.
  Turn turn() const {
    if (!IsAlone)
      return InTurn;
    if (Blocked || Now == State::Answer)
      return Turn();
    return Now == State::Starved ? Turn(Next, false) : Turn(At);
  }
  /// How much trace is waiting.
  size_t backlog() const;
  size_t backlogBytes() const;

  unsigned warps() const { return static_cast<unsigned>(Others.size()); }
  /// The warp whose turn it is.
  unsigned warp() const { return Current; }
  /// From now on it is \p Warp's turn.
  void select(unsigned Warp);
  /// Whether \p Warp waits for the rasterizer; then it is its turn.
  bool selectWaiting(unsigned Warp);
  /// The warps, as bits, that write no more unless they are spawned.
  void setEnded(uint32_t Warps);
  /// Does the instruction of State::Step, and others of the core until \p Then.
  void step(uint64_t Then) { advanceInTurn(Then); }

  /// Makes the access of State::Access, if there is a place for it. Otherwise
  /// its turn is now when one will be free. Returns whether it did.
  bool access(MemorySystem &Memory);
  /// An answer of memory. Goes on, if it was what the core needed.
  void answer(uint32_t Tag, uint64_t Then);
  /// The line that State::Fetch wants, numbered from the program's first.
  uint32_t wantedLine() const { return Words[0]; }
  /// It comes at \p Then for \p Warp, and for good if \p ForGood says so.
  void fetched(unsigned Warp, uint32_t Line, uint64_t Then, bool ForGood);
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
  void end(uint64_t End);

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
  /// Accesses to local memory, each once for every active lane.
  uint64_t localLanes() const { return LocalLanes; }
  uint64_t l1Hits() const { return L1Hits; }
  uint64_t staleLoads() const { return StaleLoads; }

private:
  /// What every instruction changes: Next, Fetched and FetchWhy. A copy, which
  /// stays in the host's registers while plain instructions follow one another.
  struct Front {
    uint64_t Next;
    uint64_t Fetched;
    CoreCycle FetchWhy;
  };
  Front front() const { return {Next, Fetched, FetchWhy}; }
  void setFront(const Front &F) {
    Next = F.Next;
    Fetched = F.Fetched;
    FetchWhy = F.FetchWhy;
  }
  void spend(CoreCycle What, uint64_t Cycles) {
    Spent.Cycles[size_t(What)] += Cycles;
    Next += Cycles;
  }
  void waitUntil(uint64_t Then, CoreCycle Why) {
    if (Then > Next)
      spend(Why, Then - Next);
  }
  void waitUntil(Front &F, uint64_t Then, CoreCycle Why) {
    const uint64_t Later = std::max(Then, F.Next);
    Spent.Cycles[size_t(Why)] += Later - F.Next;
    F.Next = Later;
  }
  const WarpTime &of(unsigned Warp) const {
    return Warp == Current ? *this : Others[Warp];
  }
  WarpTime &of(unsigned Warp) { return Warp == Current ? *this : Others[Warp]; }
  void startRun(WarpTime &W, const RunRecord &R);
  bool isInCode(WarpTime &W, uint32_t Instruction) const;
  bool waitForOperands(Front &F, const OpInfo &O);
  bool waitUntilQuiet();
  void waitForUnit(const OpInfo &O) {
    waitUntil(UnitFree[size_t(O.On)], CoreCycle::Unit);
    waitUntil(SlotAt, CoreCycle::Slot);
  }
  /// Whether an access needs a place among those in flight.
  bool needsPlace(const OpInfo &O, AccessWord A) const {
    return Timing.LoadsQueue ? O.Class != OpClass::Store : A.Lines != 0;
  }
  unsigned firstPlace() const;
  /// When a place among the accesses in flight is free; Turn::Never if unknown.
  uint64_t placeFreeAt(unsigned Place) const {
    const uint64_t Answered = InFlight.readyAt(Place);
    return Answered == Turn::Never || Answered == 0 ? Answered
                                                    : Answered + Timing.LsuHold;
  }
  size_t placeOf(const OpInfo &O, uint64_t Begin) const;
  uint64_t unitFreeAt(const OpInfo &O, uint64_t Now) const;
  bool beginsAtOnce(uint64_t Now, const OpInfo &O);
  uint64_t beginOnUnit(Front &F, const OpInfo &O);
  void fetchNext(Front &F, const OpInfo &O, uint64_t Begun);
  void issue(Front &F, const OpInfo &O);
  template <bool Ideal> bool reach(Front &F, const OpInfo &O);
  bool reach(const OpInfo &O);
  template <bool Ideal> void follow(Front &F, const OpInfo &O, uint64_t Begun);
  template <bool Ideal> uint64_t pass(Front &F, const OpInfo &O);
  uint64_t pass(const OpInfo &O);
  void finish(const OpInfo &O);
  template <bool Ideal, bool Watched> void advanceThrough();
  static constexpr uint32_t WordsOfLine = TimingLineBytes / 4;
  /// The line of an instruction, numbered from the program's first.
  uint32_t lineOfCode(size_t Instruction) const {
    return static_cast<uint32_t>(Instruction + FirstWord) / WordsOfLine;
  }
  unsigned endOfLine(uint32_t First, unsigned Position) const;
  template <bool Ideal>
  unsigned advancePlain(const OpInfo *Run, unsigned Position, unsigned End);
  bool advanceOne(const OpInfo &O);
  bool advanceParked(const OpInfo &O);
  uint64_t localAccess(const OpInfo &O, AccessWord A);
  const DataCache::Line *findInL1(uint32_t Address, uint64_t Now,
                                  unsigned Place);
  void fillL1(unsigned Place, uint64_t Then);
  void setLoaded(WarpTime &W, const OpInfo &O, uint64_t Done);
  static void setReady(WarpTime &W, unsigned Register, uint64_t Then,
                       CoreCycle Why) {
    if (Register == SinkRegister)
      return;
    W.Ready[Register] = Then;
    W.ReadyWhy[Register] = Why;
  }
  void setReady(unsigned Register, uint64_t Then, CoreCycle Why) {
    setReady(*this, Register, Then, Why);
  }

  void tell(const OpInfo *O);
  void tellIssued(const OpInfo &O);

  // Several warps.
  void advanceInTurn(uint64_t Until);
  uint64_t earliest(WarpTime &W);
  /// A warp that shares the issue slots.
  struct SlotWarp {
    unsigned Warp;
    uint64_t DecodedAt; ///< from then on slots are given to it
    uint64_t ReadyAt;   ///< when it can use one; Turn::Never if unknown
    uint64_t FullAt;    ///< from then on it keeps the decoder; see fullAt()
  };
  std::pair<unsigned, uint64_t> firstInTurn() const;
  uint64_t fullAt(const WarpTime &W) const;
  void holdDecoder();
  uint64_t earliestIssue(const WarpTime &W, const RunRecord &R) const;
  bool atSpawn(const WarpTime &W) const;
  void advanceFront();
  void spawn(const OpInfo &O);
  void arrive(const OpInfo &O, uint32_t Barrier, uint32_t Count);

  const CoreTiming Timing; ///< LsuQueue is that of all warps
  const uint32_t Unit;     ///< as memory knows it
  const bool IsAlone;      ///< there is one warp
  const bool AsksForCode;
  /// Whether the front end always has the next instruction, but behind a branch
  /// or a change of lanes, nobody waits in front of a unit, and there is one
  /// warp, and no instruction cache. Then none of that is looked at.
  const bool IsIdeal;
  const std::vector<OpInfo> *Ops = nullptr;
  /// When lines of code were there that stay in the instruction cache;
  /// Turn::Never of others. Empty without that cache.
  std::vector<uint64_t> CodeReady;
  uint32_t FirstWord = 0; ///< see begin()

  std::vector<WarpTime> Others; ///< by warp; not used for the current one
  unsigned Current = 0;
  unsigned LastIssued = 0;       ///< a warp: the others come first
  std::vector<SlotWarp> Sharing; ///< with IssueInTurn; reused
  unsigned Holder = 0;           ///< the warp that keeps the decoder from Held
  uint32_t Held = 0;             ///< warps, as bits
  /// When the current warp's slot comes, with IssueInTurn.
  uint64_t SlotAt = 0;
  State Presented = State::Starved;
  Turn InTurn;
  std::vector<std::vector<unsigned>> LocalBarriers; ///< who has arrived

  uint64_t Next = 0; ///< the earliest next issue; all before is accounted for
  std::array<uint64_t, size_t(Port::Count)> UnitFree{};
  /// From then on every unit is free.
  uint64_t UnitsBusyUntil = 0;
  /// Of a unit whose instructions wait in front of it: when the last ones
  /// begin, in a ring.
  struct UnitQueue {
    std::vector<uint64_t> Begins;
    size_t Next = 0;
  };
  std::array<UnitQueue, size_t(Port::Count)> Queues;
  /// When the places of a unit that operations keep (OpInfo::Hold) are free.
  struct UnitPlaces {
    std::vector<uint64_t> FreeAt;
    size_t Oldest = 0; ///< that was taken the longest ago

    void take(size_t Place, uint64_t Until) {
      FreeAt[Place] = Until;
      Oldest = Place + 1 == FreeAt.size() ? 0 : Place + 1;
    }
  };
  std::array<UnitPlaces, size_t(Port::Count)> Places;
  /// A set of lines for each place, and behind these one for all accesses that
  /// need none.
  LineWaits InFlight;
  struct Access {
    const OpInfo *Op = nullptr;
    unsigned Warp = 0;
    uint64_t Serial = 0;          ///< as observers know it
    std::vector<uint32_t> Misses; ///< lines that the data cache gets
    uint64_t Writes = 0;          ///< to memory, that these lines have seen
  };
  std::vector<Access> Accesses; ///< by place
  uint64_t LastDone = 0; ///< of the accesses to memory whose end is known
  DataCache L1;
  DataCacheBanks L1Banks;

  CoreTime Spent;
  const TimeWatch *Watch = nullptr;
  unsigned Number = 0; ///< as observers know it
  CoreTime Told;       ///< of Spent, what they know
  uint64_t ToldUntil = 0;
  uint64_t Serial = 0; ///< of the next instruction, if there are observers
  std::array<ClassCount, size_t(OpClass::Count)> Classes{};
  uint64_t LinesRequested = 0, LocalConflicts = 0, LocalLanes = 0, L1Hits = 0;
  uint64_t StaleLoads = 0;
};

} // namespace vorion::isasim
