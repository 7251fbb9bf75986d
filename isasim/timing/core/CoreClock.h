/// How long a core takes: an in-order pipeline whose numbers are timing.core of
/// the configuration.
#pragma once

#include "timing/common/TimeObserver.h"
#include "timing/common/Turn.h"
#include "timing/core/IssuePolicy.h"
#include "timing/core/OpClass.h"
#include "timing/memory/CacheTags.h"
#include "timing/memory/LineWaits.h"
#include "timing/trace/TraceWriter.h"
#include "vorion/isasim/Timing.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace vorion::isasim {

/// The tags of a core's data cache: they change time, never function. Loads
/// allocate, stores write through without allocating. Not coherent: it is
/// invalidated when a run begins.
class DataCache {
public:
  /// Of core \p Core; none if \p Kib is 0.
  DataCache(uint32_t Kib, uint32_t Ways, uint32_t Core) {
    if (Kib == 0)
      return;
    Tags.emplace(CacheShape{.Bytes = Kib * 1024,
                            .Ways = Ways,
                            .Banks = 1,
                            .Mshrs = 0,
                            .HitCycles = 0,
                            .Hint = false,
                            .Name = "core",
                            .Number = Core});
    Lines.resize(Tags->places());
  }

  bool exists() const { return Tags.has_value(); }
  void clear() {
    if (Tags)
      Tags->clear();
  }

  struct Line {
    Arrival Ready; ///< when it was or will be there
    /// Writes to memory that it has seen (LineWriters::count()).
    uint64_t Writes = 0;
  };
  /// The line of \p Address, or nullptr.
  const Line *find(uint32_t Address) {
    const uint32_t Number = Address / TimingLineBytes;
    const uint32_t Set = Tags->setOf(Number);
    const size_t Place = Tags->find(Number, Set);
    if (Place == CacheTags::None)
      return nullptr;
    Tags->use(Set, Place, {});
    return &Lines[Place];
  }

  /// The line of \p Address comes at \p Ready with the first \p Writes
  /// writes in it.
  void fill(uint32_t Address, const Arrival &Ready, uint64_t Writes) {
    const uint32_t Number = Address / TimingLineBytes;
    const uint32_t Set = Tags->setOf(Number);
    uint64_t Spared = 0;
    const size_t Place = Tags->victim(Set, Spared);
    Tags->replace(Set, Place, Number, {});
    Lines[Place] = {Ready, Writes};
  }

private:
  std::optional<CacheTags> Tags;
  std::vector<Line> Lines; ///< by place
};

/// The lines that a data cache has asked memory for and that have not come.
/// Loads that want such a line wait for the same answer, and are given it one
/// after the other.
class LinesInFlight {
public:
  struct Line {
    uint32_t Address = 0;
    uint64_t Writes = 0;           ///< as of DataCache::Line
    std::vector<uint32_t> Waiting; ///< tags of sets; none: nothing is asked for
  };
  void clear() { Lines.clear(); }
  /// The line of \p Address, or null.
  Line *find(uint32_t Address) {
    for (Line &L : Lines)
      if (!L.Waiting.empty() &&
          L.Address / TimingLineBytes == Address / TimingLineBytes)
        return &L;
    return nullptr;
  }
  /// A number that no line has, for the next one.
  uint32_t next() {
    const auto Free = std::ranges::find_if(
        Lines, [](const Line &L) { return L.Waiting.empty(); });
    const auto Number = static_cast<uint32_t>(Free - Lines.begin());
    if (Free == Lines.end())
      Lines.emplace_back();
    return Number;
  }
  void add(uint32_t Number, Line &&New) { Lines[Number] = std::move(New); }
  /// Line \p Number has come.
  Line take(uint32_t Number) { return std::exchange(Lines[Number], {}); }

private:
  std::vector<Line> Lines;
};

/// The banks of a data cache. A bank accepts one line per cycle. Stores and
/// misses wait in a queue behind their bank for the core's port, which sends
/// one line per cycle; a bank that sees its queue full accepts nothing. It
/// sees a line there three cycles after it has accepted it.
///
/// Where a crossbar below keeps the port waiting, it has these queues, and
/// dequeued() says when a line has left its queue.
class DataCacheBanks {
public:
  /// \p LaneQueue: lines in front of a bank whose queue is full.
  /// \p ReportsDequeues: there is a crossbar below.
  DataCacheBanks(uint32_t BanksIn, uint32_t QueueIn, uint32_t LaneQueue,
                 bool ReportsDequeues)
      : Banks(BanksIn), Queue(QueueIn), Most(QueueIn + LaneQueue),
        SeesDequeues(ReportsDequeues && Banks && Queue) {}

  bool exist() const { return Banks != 0; }
  bool seesDequeues() const { return SeesDequeues; }
  void clear() {
    FreeAt.assign(Banks, 0);
    Queued.assign(size_t{Banks} * queueRing(), {});
    Oldest.assign(Banks, 0);
    Waiting.assign(Banks, 0);
    PortAt = 0;
  }
  uint32_t bankOf(uint32_t Address) const {
    return Address / TimingLineBytes % Banks;
  }
  /// Whether the line of \p Address can wait for its bank, as far as is known.
  bool hasRoom(uint32_t Address) const {
    return !SeesDequeues || Waiting[bankOf(Address)] < Most;
  }
  /// When its bank accepts the line of \p Address, which arrives at \p Now.
  uint64_t accept(uint32_t Address, uint64_t Now) {
    const uint32_t Bank = bankOf(Address);
    uint64_t At = std::max(Now, FreeAt[Bank]);
    if (Queue && !SeesDequeues)
      while (const uint64_t Later = seesFullUntil(Bank, At))
        At = Later;
    FreeAt[Bank] = At + 1;
    return At;
  }
  /// When the port sends the line of \p Address, which its bank has accepted
  /// at \p Now, at the earliest; not counting how long the bank takes.
  uint64_t send(uint32_t Address, uint64_t Now) {
    const uint32_t Bank = bankOf(Address);
    if (SeesDequeues) {
      ++Waiting[Bank];
      return Now;
    }
    const uint64_t At = std::max(Now, PortAt);
    PortAt = At + 1;
    if (Queue) {
      Queued[Bank * queueRing() + Oldest[Bank]] = {Now + SeenAfter,
                                                   At + SeenAfter + 1};
      Oldest[Bank] = Oldest[Bank] + 1 == queueRing() ? 0 : Oldest[Bank] + 1;
    }
    return At;
  }
  /// A line has left the queue behind \p Bank.
  void dequeued(uint32_t Bank) { --Waiting[Bank]; }
  /// The line of \p Address comes from below, and is there for its first load
  /// at \p Then: the bank fills it, and gives it to \p Loads.
  void fill(uint32_t Address, uint64_t Then, size_t Loads) {
    if (SeesDequeues)
      FreeAt[bankOf(Address)] = std::max(FreeAt[bankOf(Address)], Then + Loads);
  }

private:
  /// From a line's being accepted until its bank sees it in the queue.
  static constexpr uint32_t SeenAfter = 3;
  struct QueuedLine {
    uint64_t From = 0, Until = 0; ///< seen in the queue
  };
  /// A bank has not seen those that it accepted in the last cycles.
  uint32_t queueRing() const { return Queue + SeenAfter - 1; }
  /// When a line leaves the queue behind \p Bank that the bank sees full at
  /// \p Now; 0 if it does not.
  uint64_t seesFullUntil(uint32_t Bank, uint64_t Now) const {
    uint64_t First = 0;
    uint32_t Seen = 0;
    for (uint32_t N = 0; N != queueRing(); ++N) {
      const QueuedLine &L = Queued[Bank * queueRing() + N];
      if (L.From <= Now && Now < L.Until)
        First = Seen++ ? std::min(First, L.Until) : L.Until;
    }
    return Seen < Queue ? 0 : First;
  }

  uint32_t Banks, Queue, Most;
  bool SeesDequeues;
  std::vector<uint64_t> FreeAt;   ///< by bank
  std::vector<QueuedLine> Queued; ///< by bank, a ring of the last ones
  std::vector<uint32_t> Oldest;   ///< by bank, in its ring
  std::vector<uint32_t> Waiting;  ///< by bank: lines, if SeesDequeues
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
  Arrival CodeCame;           ///< of that line, if FetchWhy is the link

  /// The next instruction is decoded at \p Then at the earliest.
  void decodeNotBefore(uint64_t Then, CoreCycle Why) {
    Fetched = std::max(Fetched, Then);
    Decoded = Fetched;
    FetchWhy = Why;
  }
  /// Nor before its line of code is there.
  void decodeNotBefore(const Arrival &OfCode) {
    decodeNotBefore(OfCode.At,
                    OfCode.crossesLink() ? CoreCycle::Link : CoreCycle::Fetch);
    CodeCame = OfCode;
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
  /// cache, where not every fetch hits. \p ReportsDequeues: as of
  /// MemorySystem::reportsDequeues().
  CoreClock(const CoreTiming &Params, MemoryPort ToMemory,
            const std::vector<TraceBuffer *> &Traces, unsigned Barriers,
            bool AsksForCode, bool ReportsDequeues);

  /// Notifies \p Observers from now on, as of number \p Own; null for none.
  void watch(const TimeWatch *Observers, unsigned Own) {
    Watch = Observers;
    Number = Own;
  }

  /// A run of the program \p Ops begins at \p Now, and is launched at
  /// \p LaunchedAt. Its first word is the \p FirstWord th of its line.
  void begin(const std::vector<OpInfo> &Ops, uint32_t FirstWord, uint64_t Now,
             uint64_t LaunchedAt);

  /// Goes on to the next request, or to the trace's end.
  void advance();

  State state() const { return IsAlone ? Now : Presented; }
  /// Whether no warp has anything left that is known.
  bool isIdle() const;
  /// When the first access that has issued and waits in front of the LSU
  /// begins.
  Turn frontTurn() const { return Turn(FrontAt); }
  void beginFront(MemorySystem &Memory);
  /// What waits there is dropped.
  void drop() {
    InFront.clear();
    FrontAt = Turn::Never;
  }
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
  void answer(const Answer &A);
  /// The line that State::Fetch wants, numbered from the program's first.
  uint32_t wantedLine() const { return Words[0]; }
  /// It comes at \p Then for \p Warp, and for good if \p ForGood says so.
  void fetched(unsigned Warp, uint32_t Line, const Arrival &Then, bool ForGood);
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
  /// Waits until \p Then for what came as \p Came says; the cycles that are not
  /// the link's are for \p Why.
  void waitFor(uint64_t &From, uint64_t Then, const Arrival &Came,
               CoreCycle Why) {
    Came.divide(From, Then, [&](bool IsLink, uint64_t End) {
      Spent.Cycles[size_t(IsLink ? CoreCycle::Link : Why)] += End - From;
      From = End;
    });
  }
  const WarpTime &of(unsigned Warp) const {
    return Warp == Current ? *this : Others[Warp];
  }
  WarpTime &of(unsigned Warp) { return Warp == Current ? *this : Others[Warp]; }
  void startRun(WarpTime &W, const RunRecord &R);
  bool isInCode(WarpTime &W, uint32_t Instruction) const;
  bool waitForOperands(Front &F, const OpInfo &O);
  bool waitUntilQuiet();
  /// When an access can issue: at once while there is room in front of the LSU.
  uint64_t lsuFreeAt() const {
    if (Timing.LsuFront == 0)
      return UnitFree[size_t(Port::Lsu)];
    if (InFront.size() >= Timing.LsuFront)
      return Turn::Never;
    const UnitQueue &Q = Queues[size_t(Port::Lsu)];
    return Q.Begins[(Q.Next + InFront.size()) % Q.Begins.size()];
  }
  /// Whether an access issues if nobody knows yet when it can begin.
  bool waitsInFront() const {
    return Timing.LsuFront && L1Banks.seesDequeues();
  }
  void waitForUnit(const OpInfo &O) {
    waitUntil(O.On == Port::Lsu ? lsuFreeAt() : UnitFree[size_t(O.On)],
              CoreCycle::Unit);
    waitUntil(SlotAt, CoreCycle::Slot);
  }
  /// Whether an access needs a place among those in flight.
  bool needsPlace(const OpInfo &O, AccessWord A) const {
    return Timing.LoadsQueue ? O.Class != OpClass::Store : A.Lines != 0;
  }
  /// The place in flight that is free first.
  unsigned firstPlace() const { return InFlight.firstOf(Timing.LsuQueue); }
  /// When a place among the accesses in flight is free; Turn::Never if unknown.
  uint64_t placeFreeAt(unsigned Place) const { return InFlight.readyAt(Place); }
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
  uint64_t localAccess(const OpInfo &O, unsigned Warp, AccessWord A,
                       uint64_t Begun, unsigned Place);
  uint64_t setLocal(WarpTime &W, const OpInfo &O, uint64_t Last);
  uint64_t delayBehind(unsigned Conflicts, uint64_t Begun);
  uint64_t beginAccess(uint64_t Free) const;
  void endAccess(uint64_t Sent, const OpInfo &O);
  bool bankIsFull(std::span<const uint32_t> Needed) const;
  void beginFrontAt(uint64_t Then);
  uint64_t begin(MemorySystem &Memory, const OpInfo &O, unsigned Warp,
                 AccessWord A, std::span<const uint32_t> Lines, uint64_t Begun,
                 unsigned Place);
  bool waitForAccess(uint64_t Then);
  const DataCache::Line *findInL1(uint32_t Address, uint64_t Now,
                                  unsigned Place);
  uint64_t load(MemorySystem &Memory, unsigned Place, CacheRequest &R);
  uint64_t leave(uint64_t Then, bool IsLoad);
  void keepForFill(uint64_t Ready);
  void lineComes(const Answer &A);
  void lineDequeued(uint32_t Bank, uint64_t Then);
  void accessDone(unsigned Place);
  void setLoaded(unsigned Warp, const OpInfo &O, const Arrival &Done);
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
  uint64_t fullAt(const WarpTime &W) const;
  void holdDecoder(unsigned Shared);
  uint64_t earliestIssue(const WarpTime &W, const RunRecord &R) const;
  bool atSpawn(const WarpTime &W) const;
  void advanceFront();
  void spawn(const OpInfo &O);
  void arrive(const OpInfo &O, uint32_t Barrier, uint32_t Count);

  const CoreTiming Timing; ///< LsuQueue is that of all warps
  const MemoryPort ToMemory;
  const bool IsAlone; ///< there is one warp
  const bool AsksForCode;
  /// Whether the front end always has the next instruction, but behind a branch
  /// or a change of lanes, nobody waits in front of a unit, and there is one
  /// warp, and no instruction cache. Then none of that is looked at.
  const bool IsIdeal;
  const std::vector<OpInfo> *Ops = nullptr;
  /// When lines of code were there that stay in the instruction cache;
  /// Turn::Never of others. Empty without that cache.
  std::vector<Arrival> CodeReady;
  uint32_t FirstWord = 0; ///< see begin()

  std::vector<WarpTime> Others; ///< by warp; not used for the current one
  unsigned Current = 0;
  unsigned LastIssued = 0; ///< a warp: the others come first
  static constexpr unsigned MostWarps = 32;
  /// The warps that share the issue slots, and for each the cycle from which it
  /// keeps the decoder (fullAt()). holdDecoder() reads both.
  std::array<WarpToIssue, MostWarps> Sharing{};
  std::array<uint64_t, MostWarps> FullAts{};
  unsigned Holder = 0; ///< the warp that keeps the decoder from Held
  uint32_t Held = 0;   ///< warps, as bits
  IssuePolicy IssueOrder;
  /// When the current warp's slot comes, if it was given one.
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

    uint64_t oldest() const { return Begins[Next]; }
    void add(uint64_t Begun) {
      Begins[Next] = Begun;
      Next = Next + 1 == Begins.size() ? 0 : Next + 1;
    }
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
  /// When all words of the last accesses to the data cache have left the lanes.
  UnitQueue LeftForCache;
  /// An access to local memory that later ones may still delay.
  struct LocalWait {
    const OpInfo *Op = nullptr;
    unsigned Warp = 0, Place = 0, Conflicts = 1;
    uint64_t Last = 0; ///< when its bank gives the last word
  };
  /// The last accesses to local memory, in a ring: those whose words lanes
  /// still keep, and the one behind them.
  std::vector<LocalWait> LocalWaits;
  size_t OldestLocal = 0;
  /// A set of lines for each place, and behind these one for all accesses that
  /// need none.
  LineWaits InFlight;
  struct LoadInFlight {
    const OpInfo *Op = nullptr;
    unsigned Warp = 0;
    uint64_t Serial = 0; ///< as observers know it
  };
  std::vector<LoadInFlight> Accesses; ///< by place
  /// An access that has issued and waits in front of the LSU for something of
  /// which nobody knows yet when it comes.
  struct FrontAccess {
    const OpInfo *Op;
    unsigned Warp;
    uint64_t Serial, IssuedAt;
    AccessWord Word;
    std::array<uint32_t, 32> Lines; ///< more than AccessWord::Lines
  };
  std::deque<FrontAccess> InFront;
  uint64_t FrontAt = Turn::Never;
  Arrival LastDone; ///< of the accesses to memory whose end is known
  /// By warp and register: how its value came, if that is why it waits.
  std::vector<std::array<Arrival, NumRegisters>> Loaded;
  /// \name Kinds of tickets beside those of InFlight
  /// @{
  static constexpr uint32_t LineTicket = 1U << 30; ///< and a line of L1Misses
  static constexpr uint32_t DequeueTicket = 2U << 30; ///< and a bank of L1Banks
  /// @}
  DataCache L1;
  DataCacheBanks L1Banks;
  LinesInFlight L1Misses;
  /// When each of the lines that loads may have in flight is free.
  std::vector<uint64_t> LineFree;
  size_t NextLine = 0; ///< of these, that the next one takes
  /// When lines from memory take the data cache, with DcacheFillCycles.
  std::deque<uint64_t> FillTurns;
  /// Lines that the present access has fetched and that come at a known time.
  struct Fill {
    uint32_t Address;
    Arrival Then;
  };
  std::vector<Fill> Fills;

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
