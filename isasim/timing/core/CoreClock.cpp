#include "timing/core/CoreClock.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace vorion::isasim {

/// \p P with the length of the load/store queue of a core of \p Warps warps.
static CoreTiming forWarps(CoreTiming P, size_t Warps) {
  P.LsuQueue =
      std::max(P.LsuQueue, P.LsuQueuePerWarp * static_cast<uint32_t>(Warps));
  return P;
}

CoreClock::CoreClock(const CoreTiming &Params, MemoryPort Port,
                     const std::vector<TraceBuffer *> &Traces,
                     unsigned Barriers, bool AsksForCodeIn,
                     bool ReportsDequeues)
    : Timing(forWarps(Params, Traces.size())), ToMemory(Port),
      IsAlone(Traces.size() == 1), AsksForCode(AsksForCodeIn),
      IsIdeal(Timing.FetchInterval == 1 && Timing.BranchCycles == 1 &&
              Timing.SplitCycles == 1 && Timing.JoinCycles == 1 &&
              Timing.CsrCycles == 1 && Timing.UnitQueue == 0 &&
              Timing.Fpu == 0 && !AsksForCode && IsAlone),
      Others(Traces.size()),
      IssueOrder({Port.Unit, static_cast<uint32_t>(Traces.size())},
                 Timing.IssueInTurn != 0),
      LocalBarriers(Barriers), InFlight(ToMemory, Timing.LsuQueue + 1),
      Accesses(Timing.LsuQueue), Loaded(Traces.size()),
      L1(Timing.DcacheKib, Timing.DcacheWays, Port.Unit),
      L1Banks(L1.exists() ? Timing.DcacheBanks : 0, Timing.DcacheStoreQueue,
              Timing.LaneBuffers, ReportsDequeues) {
  for (unsigned W = 0; W != Others.size(); ++W)
    of(W).Trace = Traces[W];
}

void CoreClock::begin(const std::vector<OpInfo> &Program, uint32_t WordOfLine,
                      uint64_t Start, uint64_t LaunchedAt) {
  Ops = &Program;
  FirstWord = WordOfLine;
  if (AsksForCode)
    CodeReady.assign(lineOfCode(Program.size() - 1) + 1, {Turn::Never});
  Next = Start;
  UnitFree.fill(0);
  for (UnitQueue &Q : Queues)
    Q = {std::vector<uint64_t>(Timing.UnitQueue), 0};
  Queues[size_t(Port::Lsu)] = {std::vector<uint64_t>(Timing.LsuFront), 0};
  LeftForCache = {std::vector<uint64_t>(Timing.LaneBuffers), 0};
  drop();
  LineFree.assign(Timing.LinesInFlight, 0);
  FillTurns.clear();
  LocalWaits.assign(Timing.LaneBuffers + 1, {});
  OldestLocal = 0;
  Places[size_t(Port::Fpu)] = {std::vector<uint64_t>(Timing.FpInFlight), 0};
  Places[size_t(Port::Alu)] = {std::vector<uint64_t>(1), 0}; // the divider
  for (unsigned N = 0; N <= Timing.LsuQueue; ++N)
    InFlight.begin(N);
  UnitsBusyUntil = 0;
  LastDone = {};
  L1.clear();
  L1Banks.clear();
  L1Misses.clear();
  Spent = Told = {};
  ToldUntil = Start;
  Serial = 0;
  Classes = {};
  LinesRequested = LocalConflicts = LocalLanes = L1Hits = StaleLoads = 0;
  for (const auto &[Why, Cycles] :
       {std::pair{CoreCycle::Launch, LaunchedAt - Start},
        {CoreCycle::Start, uint64_t{Timing.StartCycles}}}) {
    spend(Why, Cycles);
    if (Watch)
      tell(nullptr);
  }
  select(0);
  for (unsigned W = 0; W != Others.size(); ++W) {
    WarpTime New;
    New.Trace = of(W).Trace;
    New.At = LaunchedAt;
    New.ReadyWhy.fill(CoreCycle::Operand);
    New.Fetched = Next;
    of(W) = std::move(New);
  }
  for (auto &Arrived : LocalBarriers)
    Arrived.clear();
  LastIssued = 0;
  SlotAt = 0;
  Presented = State::Starved;
  InTurn = Turn(Next, false);
}

/// Observers get to know what has been spent since they were told last: for
/// \p O, or for no instruction if that is null. Its issue comes last.
void CoreClock::tell(const OpInfo *O) {
  const bool Issues = Spent.Cycles[size_t(CoreCycle::Issue)] !=
                      Told.Cycles[size_t(CoreCycle::Issue)];
  CoreSpent S;
  S.Core = Number;
  if (O)
    S.Instruction = static_cast<uint32_t>(O - Ops->data());
  for (size_t K = 1; K <= Spent.Cycles.size(); ++K) {
    const size_t N = K % Spent.Cycles.size();
    const uint64_t Cycles =
        Spent.Cycles[N] - std::exchange(Told.Cycles[N], Spent.Cycles[N]);
    if (Cycles == 0)
      continue;
    S.What = static_cast<CoreCycle>(N);
    S.When = {ToldUntil, ToldUntil + Cycles};
    ToldUntil += Cycles;
    Watch->tell([&](TimeObserver &Each) { Each.coreSpent(S); });
  }
  if (O && Issues)
    tellIssued(*O);
}

void CoreClock::tellIssued(const OpInfo &O) {
  CoreIssued I{.Core = Number,
               .Warp = Current,
               .Instruction = static_cast<uint32_t>(&O - Ops->data()),
               .Serial = Serial++,
               .At = ToldUntil - 1,
               .ResultAt = ToldUntil};
  if (O.Rd != SinkRegister)
    I.ResultAt = Ready[O.Rd] == Turn::Never ? CoreIssued::Unknown : Ready[O.Rd];
  Watch->tell([&](TimeObserver &Each) { Each.coreIssued(I); });
}

void CoreClock::end(uint64_t End) {
  spend(CoreCycle::Ended, End - Next);
  if (Watch)
    tell(nullptr);
}

void CoreClock::fetched(unsigned Warp, uint32_t Line, const Arrival &Then,
                        bool ForGood) {
  select(Warp);
  Blocked = false;
  Now = State::Starved;
  CodeLine = Line;
  decodeNotBefore(Then);
  if (ForGood)
    CodeReady[Line] = Then;
}

/// Whether a bank of the data cache that some of \p Needed need takes nothing
/// until a line leaves the port.
bool CoreClock::bankIsFull(std::span<const uint32_t> Needed) const {
  return L1Banks.seesDequeues() &&
         std::ranges::any_of(
             Needed, [this](uint32_t Line) { return !L1Banks.hasRoom(Line); });
}

/// The current access cannot be made before \p Then.
bool CoreClock::waitForAccess(uint64_t Then) {
  At = Then;
  if (!IsAlone)
    advanceInTurn(0);
  return false;
}

/// The data cache's line for a load at \p Place whose address is known at
/// \p Now; nullptr if it has none.
const DataCache::Line *CoreClock::findInL1(uint32_t Address, uint64_t Now,
                                           unsigned Place) {
  const DataCache::Line *Line = L1.find(Address);
  if (Line) {
    ++L1Hits;
    const uint64_t Read = Now + Timing.DcacheCycles;
    InFlight.add(Place, Line->Ready.At > Read ? Line->Ready : Arrival{Read});
  }
  return Line;
}

/// Asks memory for a line of the data cache that the load at \p Place wants.
/// Returns when it comes, Turn::Never if that is not known.
uint64_t CoreClock::load(MemorySystem &Memory, unsigned Place,
                         CacheRequest &R) {
  const uint32_t Free = L1Misses.next();
  R.From = {ToMemory.Unit, LineTicket | Free};
  const uint64_t Writes = Memory.writers().count();
  if (const auto Then = Memory.access(ToMemory, R)) {
    InFlight.add(Place, *Then);
    Fills.push_back({R.Address, *Then});
    keepForFill(Then->At);
    return Then->At;
  }
  L1Misses.add(Free, {R.Address, Writes, {InFlight.expect(Place)}});
  return Turn::Never;
}

/// A line comes from memory that is there for its load at \p Ready. The data
/// cache fills it, and the request is looked up again.
void CoreClock::keepForFill(uint64_t Ready) {
  if (Timing.DcacheFillCycles)
    FillTurns.push_back(Ready - Timing.DcacheCycles - Timing.DcacheFillCycles);
}

/// When a line of an access leaves for the data cache, \p Then at the earliest.
uint64_t CoreClock::leave(uint64_t Then, bool IsLoad) {
  if (IsLoad && Timing.LinesInFlight) {
    NextLine = static_cast<size_t>(std::ranges::min_element(LineFree) -
                                   LineFree.begin());
    Then = std::max(Then, LineFree[NextLine]);
  }
  while (!FillTurns.empty() &&
         FillTurns.front() + Timing.DcacheFillCycles <= Then)
    FillTurns.pop_front();
  for (const uint64_t Fill : FillTurns)
    if (Fill <= Then)
      Then = std::max(Then, Fill + Timing.DcacheFillCycles);
  return Then;
}

bool CoreClock::access(MemorySystem &Memory) {
  const OpInfo &O = *Waiting;
  const auto A = std::bit_cast<AccessWord>(Trace->word());
  const std::span<const uint32_t> Lines(Trace->words() + 1, A.Lines);
  if (const uint64_t Room = lsuFreeAt(); waitsInFront() && Room > At)
    return waitForAccess(Room);
  unsigned Place = Timing.LsuQueue;
  uint64_t Free = 0;
  if (needsPlace(O, A)) {
    Place = firstPlace();
    Free = placeFreeAt(Place);
  }
  const bool IsBlocked = Free == Turn::Never || bankIsFull(Lines);
  const bool Waits = waitsInFront() && (IsBlocked || !InFront.empty());
  if (!Waits && (IsBlocked || (Free > At && Timing.LsuFront == 0)))
    return waitForAccess(IsBlocked ? Turn::Never : Free);
  if (needsPlace(O, A) && !Waits) {
    if (At > Next)
      waitFor(Next, At, InFlight.arrivalOf(Place), CoreCycle::LsuQueue);
    InFlight.begin(Place);
    Accesses[Place] = {&O, Current, Serial};
  }
  waitUntil(At, CoreCycle::LsuQueue);
  Now = State::Starved;
  Trace->popWords(1 + A.Lines);
  LocalLanes += A.Lines == 0 ? Lanes : 0;
  if (Waits) {
    InFront.push_back({&O, Current, Serial, Next, A, {}});
    std::ranges::copy(Lines, InFront.back().Lines.begin());
    setLoaded(Current, O, {Turn::Never});
    beginFrontAt(At);
  } else {
    begin(Memory, O, Current, A, Lines, beginAccess(Free), Place);
  }
  finish(O);
  return true;
}

/// When the first access that waits in front of the LSU begins, if that is not
/// known yet: not before \p Then, when something has changed that it may have
/// waited for.
void CoreClock::beginFrontAt(uint64_t Then) {
  if (InFront.empty() || FrontAt != Turn::Never)
    return;
  const FrontAccess &A = InFront.front();
  const uint64_t Free =
      needsPlace(*A.Op, A.Word) ? placeFreeAt(firstPlace()) : 0;
  if (Free != Turn::Never && !bankIsFull({A.Lines.data(), A.Word.Lines}))
    FrontAt = std::max({Then, Free, A.IssuedAt, UnitFree[size_t(Port::Lsu)]});
}

void CoreClock::beginFront(MemorySystem &Memory) {
  const FrontAccess A = InFront.front();
  const uint64_t Begun = std::exchange(FrontAt, Turn::Never);
  InFront.pop_front();
  const OpInfo &O = *A.Op;
  unsigned Place = Timing.LsuQueue;
  if (needsPlace(O, A.Word)) {
    Place = firstPlace();
    InFlight.begin(Place);
    Accesses[Place] = {&O, A.Warp, A.Serial};
  }
  const uint64_t Done = begin(Memory, O, A.Warp, A.Word,
                              {A.Lines.data(), A.Word.Lines}, Begun, Place);
  if (Watch && Done != Turn::Never)
    Watch->tell([&](TimeObserver &Each) {
      Each.loadDone(Number, A.Serial, Done + O.Latency);
    });
  beginFrontAt(Begun);
  // There is room for one more.
  for (unsigned W = 0; W != Others.size(); ++W)
    if (WarpTime &Each = of(W);
        Each.Now == State::Access && Each.At == Turn::Never)
      Each.At = std::max(Next, lsuFreeAt());
  if (Now == State::Answer || !IsAlone)
    advance();
}

/// The LSU begins the access \p O of \p Warp, to local memory or to \p Lines,
/// at
/// \p Begun. Returns when it is done, Turn::Never if that is not known.
uint64_t CoreClock::begin(MemorySystem &Memory, const OpInfo &O, unsigned Warp,
                          AccessWord A, std::span<const uint32_t> Lines,
                          uint64_t Begun, unsigned Place) {
  if (A.Lines == 0) {
    const uint64_t Done = localAccess(O, Warp, A, Begun, Place);
    if (Place != Timing.LsuQueue)
      InFlight.begin(Place, Done);
    return Done;
  }
  const CacheOp Op = O.Class == OpClass::Load     ? CacheOp::Read
                     : O.Class == OpClass::Atomic ? CacheOp::Atomic
                     : A.Whole                    ? CacheOp::WriteWhole
                                                  : CacheOp::Write;
  const uint32_t Extra = Op == CacheOp::Atomic ? A.Conflicts - 1 : 0;
  const bool UsesL1 = L1.exists() && O.Class == OpClass::Load;
  bool IsStale = false;
  const uint64_t First = Begun + Timing.AguCycles;
  const uint64_t Writes = Memory.writers().count();
  uint64_t Then = First, Last = First;
  uint32_t Room = Timing.LinesAtOnce;
  for (const uint32_t Address : Lines) {
    if (L1Banks.exist()) {
      Then = L1Banks.accept(Address, First);
    } else if (Room == 0) {
      Then += Timing.LineCycles;
      Room = Timing.LinesAtOnce;
    }
    --Room;
    if (L1.exists() && !L1Banks.exist())
      Then = leave(Then, UsesL1);
    Last = std::max(Last, Then);
    if (UsesL1) {
      const auto *Line = findInL1(Address, Then, Place);
      if (!LineFree.empty())
        LineFree[NextLine] =
            Line ? std::max(Line->Ready.At, Then + Timing.DcacheCycles) : Then;
      if (Line) {
        IsStale |=
            Memory.writers().isWritten(Address, Line->Writes, ToMemory.Unit);
        continue;
      }
      if (LinesInFlight::Line *Asked = L1Misses.find(Address)) {
        Asked->Waiting.push_back(InFlight.expect(Place));
        continue;
      }
    }
    // Made for each, and passed on as it is: the host would wait for a copy.
    CacheRequest Below{
        .Now = Then, .Address = Address, .Op = Op, .Extra = Extra};
    if (L1Banks.exist())
      Below.Now = L1Banks.send(Address, Then);
    // The tags have been looked up before the request goes on.
    Below.Now += UsesL1 || L1Banks.seesDequeues() ? Timing.DcacheCycles : 0;
    if (L1Banks.seesDequeues())
      Below.Dequeued = {ToMemory.Unit, DequeueTicket | L1Banks.bankOf(Address)};
    if (UsesL1) {
      const uint64_t Comes = load(Memory, Place, Below);
      if (!LineFree.empty() && Comes != Turn::Never)
        LineFree[NextLine] = Comes;
    } else {
      InFlight.ask(Memory, Place, Below);
    }
  }
  // All have been looked up before the first comes.
  for (const Fill &F : Fills)
    L1.fill(F.Address, F.Then, Writes);
  Fills.clear();
  const uint64_t Leaving = Last + Timing.LineCycles - First;
  LinesRequested += A.Lines;
  StaleLoads += IsStale;
  uint64_t Sent = Begun + Leaving - 1;
  if (Timing.LaneBuffers) {
    const uint64_t Left =
        std::exchange(Sent, std::max(Begun, LeftForCache.oldest()));
    LeftForCache.add(Left + 1);
  }
  endAccess(Sent, O);
  setLoaded(Warp, O, InFlight.arrivalOf(Place));
  return InFlight.readyAt(Place);
}

/// An access \p O of \p Warp is done at \p Done, if that is known.
void CoreClock::setLoaded(unsigned Warp, const OpInfo &O, const Arrival &Done) {
  const bool IsKnown = Done.At != Turn::Never;
  if (IsKnown && Done.At > LastDone.At)
    LastDone = Done;
  for (const unsigned Register : {O.Rd, O.HighRd}) {
    setReady(of(Warp), Register, IsKnown ? Done.At + O.Latency : Done.At,
             Done.crossesLink() ? CoreCycle::Link : CoreCycle::Memory);
    if (Done.crossesLink())
      Loaded[Warp][Register] = Done;
  }
}

/// The access at \p Place has been answered.
void CoreClock::accessDone(unsigned Place) {
  const Arrival Done = InFlight.arrivalOf(Place);
  if (Done.At > LastDone.At)
    LastDone = Done;
  if (Place == Timing.LsuQueue)
    return;
  const LoadInFlight &A = Accesses[Place];
  setLoaded(A.Warp, *A.Op, Done);
  if (Watch)
    Watch->tell([&](TimeObserver &Each) {
      Each.loadDone(Number, A.Serial, Done.At + A.Op->Latency);
    });
  beginFrontAt(Done.At);
  // The access in front may have waited for a place.
  if (Now == State::Access)
    At = std::min(At, std::max(Next, Done.At));
}

/// A line of the data cache comes.
void CoreClock::lineComes(const Answer &A) {
  const LinesInFlight::Line Line = L1Misses.take(A.To.Tag & ~LineTicket);
  L1.fill(Line.Address, A.arrival(), Line.Writes);
  keepForFill(A.At);
  // It is looked up again behind the fill.
  L1Banks.fill(Line.Address, A.At - Timing.DcacheCycles + 1,
               Line.Waiting.size() - 1);
  Answer Each = A;
  for (const uint32_t Tag : Line.Waiting) {
    Each.To.Tag = Tag;
    if (const auto Place = InFlight.answer(Each))
      accessDone(*Place);
    ++Each.At;
  }
}

/// A line has left the queue of \p Bank at \p Then: what waits for its bank
/// tries again.
void CoreClock::lineDequeued(uint32_t Bank, uint64_t Then) {
  L1Banks.dequeued(Bank);
  beginFrontAt(Then);
  for (unsigned W = 0; W != Others.size(); ++W)
    if (WarpTime &Each = of(W);
        Each.Now == State::Access && Each.At == Turn::Never)
      Each.At = std::max(Next, Then);
}

void CoreClock::answer(const Answer &A) {
  if (A.To.Tag & DequeueTicket)
    lineDequeued(A.To.Tag & ~DequeueTicket, A.At);
  else if (A.To.Tag & LineTicket)
    lineComes(A);
  else if (const auto Place = InFlight.answer(A))
    accessDone(*Place);
  if (Now == State::Answer || !IsAlone)
    advance();
}

void CoreClock::resume(uint64_t Then, CoreCycle Why) {
  Blocked = false;
  Now = State::Starved;
  waitUntil(Then, Why);
  setReady(Waiting->Rd, Next + Waiting->Latency, CoreCycle::Operand);
  finish(*Waiting);
}

bool CoreClock::isIdle() const {
  for (unsigned W = 0; W != Others.size(); ++W)
    if (of(W).Now != State::Starved || !of(W).Trace->empty())
      return false;
  return InFront.empty();
}

size_t CoreClock::backlog() const {
  size_t Sum = 0;
  for (unsigned W = 0; W != Others.size(); ++W)
    Sum += of(W).Trace->size();
  return Sum;
}

size_t CoreClock::backlogBytes() const {
  size_t Sum = 0;
  for (unsigned W = 0; W != Others.size(); ++W)
    Sum += of(W).Trace->bytes();
  return Sum;
}

void CoreClock::setEnded(uint32_t Warps) {
  for (unsigned W = 0; W != Others.size(); ++W)
    of(W).Ended = Warps >> W & 1;
}

uint64_t CoreClock::quietAt() const {
  if (!InFront.empty())
    return Turn::Never;
  for (unsigned N = 0; N <= Timing.LsuQueue; ++N)
    if (InFlight.readyAt(N) == Turn::Never)
      return Turn::Never;
  return std::max(Next, LastDone.At);
}

} // namespace vorion::isasim
