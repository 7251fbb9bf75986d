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

CoreClock::CoreClock(const CoreTiming &Params, MemoryPort ToMemory,
                     const std::vector<TraceBuffer *> &Traces,
                     unsigned Barriers, bool AsksForCodeIn)
    : Timing(forWarps(Params, Traces.size())), Unit(ToMemory.Unit),
      IsAlone(Traces.size() == 1), AsksForCode(AsksForCodeIn),
      IsIdeal(Timing.FetchInterval == 1 && Timing.BranchCycles == 1 &&
              Timing.SplitCycles == 1 && Timing.JoinCycles == 1 &&
              Timing.CsrCycles == 1 && Timing.UnitQueue == 0 &&
              Timing.Fpu == 0 && !AsksForCode && IsAlone),
      Others(Traces.size()), LocalBarriers(Barriers),
      InFlight(ToMemory, Timing.LsuQueue + 1), Accesses(Timing.LsuQueue),
      L1(Timing.DcacheKib, Timing.DcacheWays),
      L1Banks(L1.exists() ? Timing.DcacheBanks : 0, Timing.DcacheStoreQueue) {
  for (unsigned W = 0; W != Others.size(); ++W)
    of(W).Trace = Traces[W];
}

void CoreClock::begin(const std::vector<OpInfo> &Program, uint32_t WordOfLine,
                      uint64_t Start) {
  Ops = &Program;
  FirstWord = WordOfLine;
  if (AsksForCode)
    CodeReady.assign(lineOfCode(Program.size() - 1) + 1, Turn::Never);
  Next = Start;
  UnitFree.fill(0);
  for (UnitQueue &Q : Queues)
    Q = {std::vector<uint64_t>(Timing.UnitQueue), 0};
  Places[size_t(Port::Fpu)] = {std::vector<uint64_t>(Timing.FpInFlight), 0};
  Places[size_t(Port::Alu)] = {std::vector<uint64_t>(1), 0}; // the divider
  for (unsigned N = 0; N <= Timing.LsuQueue; ++N)
    InFlight.begin(N);
  UnitsBusyUntil = 0;
  LastDone = 0;
  L1.clear();
  L1Banks.clear();
  Spent = Told = {};
  ToldUntil = Start;
  Serial = 0;
  Classes = {};
  LinesRequested = LocalConflicts = LocalLanes = L1Hits = StaleLoads = 0;
  spend(CoreCycle::Start, Timing.StartCycles);
  if (Watch)
    tell(nullptr);
  select(0);
  for (unsigned W = 0; W != Others.size(); ++W) {
    WarpTime New;
    New.Trace = of(W).Trace;
    New.At = Start;
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

void CoreClock::fetched(unsigned Warp, uint32_t Line, uint64_t Then,
                        bool ForGood) {
  select(Warp);
  Blocked = false;
  Now = State::Starved;
  CodeLine = Line;
  decodeNotBefore(Then, CoreCycle::Fetch);
  if (ForGood)
    CodeReady[Line] = Then;
}

/// The data cache's line for a load at \p Place whose address is known at
/// \p Now; nullptr if it has none.
const DataCache::Line *CoreClock::findInL1(uint32_t Address, uint64_t Now,
                                           unsigned Place) {
  const DataCache::Line *Line = L1.find(Address);
  if (Line) {
    ++L1Hits;
    InFlight.add(Place, std::max(Now + Timing.DcacheCycles, Line->ReadyAt));
  } else {
    Accesses[Place].Misses.push_back(Address);
  }
  return Line;
}

bool CoreClock::access(MemorySystem &Memory) {
  const OpInfo &O = *Waiting;
  const auto A = std::bit_cast<AccessWord>(Trace->word());
  unsigned Place = Timing.LsuQueue;
  if (needsPlace(O, A)) {
    Place = firstPlace();
    if (const uint64_t Free = placeFreeAt(Place); Free > At) {
      At = Free;
      return false;
    }
    waitUntil(At, CoreCycle::LsuQueue);
    InFlight.begin(Place);
    Accesses[Place] = {&O, Current, Serial, {}, Memory.writers().count()};
  }
  Now = State::Starved;
  if (A.Lines == 0) {
    Trace->popWords(1);
    InFlight.begin(Place, localAccess(O, A));
    return true;
  }

  CacheRequest R{.Now = At + Timing.AguCycles, .Address = 0};
  if (O.Class == OpClass::Atomic) {
    R.Op = CacheOp::Atomic;
    R.Extra = A.Conflicts - 1;
  } else if (O.Class == OpClass::Store) {
    R.Op = A.Whole ? CacheOp::WriteWhole : CacheOp::Write;
  }
  const bool UsesL1 = L1.exists() && O.Class == OpClass::Load;
  bool IsStale = false;
  const uint64_t First = R.Now;
  uint64_t Last = First;
  uint32_t Room = Timing.LinesAtOnce;
  for (unsigned N = 0; N != A.Lines; ++N, --Room) {
    R.Address = Trace->word(1 + N);
    if (L1Banks.exist()) {
      R.Now = L1Banks.accept(R.Address, First);
      Last = std::max(Last, R.Now);
    } else if (Room == 0) {
      Last = R.Now += Timing.LineCycles;
      Room = Timing.LinesAtOnce;
    }
    if (UsesL1)
      if (const auto *Line = findInL1(R.Address, R.Now, Place)) {
        IsStale |= Memory.writers().isWritten(R.Address, Line->Writes, Unit);
        continue;
      }
    CacheRequest Below = R;
    // The tags have been looked up before the request goes on.
    Below.Now += UsesL1 ? Timing.DcacheCycles : 0;
    if (L1Banks.exist())
      Below.Now = L1Banks.send(R.Address, Below.Now);
    InFlight.ask(Memory, Place, Below);
  }
  const uint64_t Leaving = Last + Timing.LineCycles - First;
  LinesRequested += A.Lines;
  StaleLoads += IsStale;
  Trace->popWords(1 + A.Lines);
  UnitFree[size_t(Port::Lsu)] = At + std::max<uint64_t>(Leaving, O.Interval);
  const uint64_t Done = InFlight.readyAt(Place);
  if (UsesL1 && Done != Turn::Never)
    fillL1(Place, Done);
  setLoaded(*this, O, Done);
  finish(O);
  return true;
}

/// An access \p O of \p W is done at \p Done, if that is known.
void CoreClock::setLoaded(WarpTime &W, const OpInfo &O, uint64_t Done) {
  const bool IsKnown = Done != Turn::Never;
  if (IsKnown)
    LastDone = std::max(LastDone, Done);
  for (const unsigned Register : {O.Rd, O.HighRd})
    setReady(W, Register, IsKnown ? Done + O.Latency : Done, CoreCycle::Memory);
}

/// The lines that the load at \p Place asked memory for come at \p Then.
void CoreClock::fillL1(unsigned Place, uint64_t Then) {
  for (const uint32_t Line : Accesses[Place].Misses)
    L1.fill(Line, Then, Accesses[Place].Writes);
}

void CoreClock::answer(uint32_t Tag, uint64_t Then) {
  const std::optional<unsigned> Place = InFlight.answer(Tag, Then);
  if (!Place)
    return;
  const uint64_t Done = InFlight.readyAt(*Place);
  LastDone = std::max(LastDone, Done);
  if (*Place != Timing.LsuQueue) {
    const Access &A = Accesses[*Place];
    fillL1(*Place, Done);
    setLoaded(of(A.Warp), *A.Op, Done);
    if (Watch)
      Watch->tell([&](TimeObserver &Each) {
        Each.loadDone(Number, A.Serial, Done + A.Op->Latency);
      });
    // The access in front may have waited for a place.
    if (Now == State::Access)
      At = std::min(At, std::max(Next, Done + Timing.LsuHold));
  }
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
  return true;
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
  for (unsigned N = 0; N <= Timing.LsuQueue; ++N)
    if (InFlight.readyAt(N) == Turn::Never)
      return Turn::Never;
  return std::max(Next, LastDone);
}

} // namespace vorion::isasim
