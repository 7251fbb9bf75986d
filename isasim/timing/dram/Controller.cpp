#include "timing/dram/Controller.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <fmt/format.h>

namespace vorion::isasim::dram {

namespace {

/// Who goes first at one tick.
enum Class : uint8_t { OfPromoted, OfRefresh, OfQueue, OfCapped, OfClosing };

/// The order of what is considered last of its class.
constexpr uint64_t Last = Never;

uint32_t burstsOfLine(const TimingTable &T, const ControllerOptions &O) {
  return (O.LineBytes + T.BurstBytes - 1) / T.BurstBytes;
}

} // namespace

Expected<Success> check(const TimingTable &Table,
                        const ControllerOptions &Options) {
  const auto Fail = [](std::string Text) { return Error{"", std::move(Text)}; };
  const uint32_t Bursts = burstsOfLine(Table, Options);
  if (Options.LineBytes == 0 || Options.LineBytes > Table.RowBytes)
    return Fail(fmt::format("line_bytes is {}, expected 1 to a row's {}",
                            Options.LineBytes, Table.RowBytes));
  if (std::min(Options.ReadQueue, Options.WriteQueue) < Bursts)
    return Fail(fmt::format("a queue has room for {} bursts, expected the {} "
                            "of a line",
                            std::min(Options.ReadQueue, Options.WriteQueue),
                            Bursts));
  if (Options.DrainAbove > 100 || Options.DrainBelow > Options.DrainAbove)
    return Fail(fmt::format("writes are drained above {} % until below {} %, "
                            "expected at most 100 and no more than that",
                            Options.DrainAbove, Options.DrainBelow));
  if (Options.MostDrained == 0)
    return Fail("most_drained is 0, expected a burst at least");
  if (Options.Refresh == ControllerOptions::RefreshBy::Bank &&
      Table.BankRefreshInterval == 0)
    return Fail(fmt::format("{} has no refresh by bank: its table has no "
                            "bank_refresh_interval",
                            Table.Standard));
  return Success{};
}

Controller::Controller(const TimingTable &Table,
                       const ControllerOptions &Options)
    : T(Table), O(Options), BurstsOfLine(burstsOfLine(T, O)),
      Above(O.DrainAbove * O.WriteQueue / 100),
      // An empty queue ends a drain, however small it is.
      Below(std::max(1U, O.DrainBelow * O.WriteQueue / 100)),
      OfOthers(groups() * Commands), Banks(T.banks()),
      Common((groups() + T.Ranks) * Commands), Ranks(T.Ranks) {
  for (size_t C = 0; C != Commands; ++C)
    LaterTicks[C] = T.CommandTicks[C] - 1;
  for (const Constraint &C : T.Constraints)
    if (isIssued(C.To))
      addSteps(C);
  BusOf[size_t(Command::Read)] = BusOf[size_t(Command::Write)] = T.HasColumnBus;
  for (uint32_t B = 0; B != Banks.size(); ++B) {
    Banks[B].Group = B / T.BanksPerGroup;
    Banks[B].Rank = B / T.banksPerRank();
    Banks[B].Common = static_cast<uint32_t>(Banks[B].Group * Commands);
  }
  if (O.Refresh == ControllerOptions::RefreshBy::Rank)
    RefreshInterval = T.RefreshInterval;
  if (O.Refresh == ControllerOptions::RefreshBy::Bank)
    RefreshInterval = T.BankRefreshInterval;
  for (uint32_t R = 0; R != T.Ranks; ++R) {
    Ranks[R].Activations.assign(Window, Never);
    // Ranks take turns, so that they are not refreshed at once.
    if (RefreshInterval != Never)
      Ranks[R].NextRefresh = RefreshInterval + R * RefreshInterval / T.Ranks;
  }
  for (const Rank &R : Ranks)
    NextRefresh = std::min(NextRefresh, R.NextRefresh);
  Queues[0].Capacity = O.ReadQueue;
  Queues[1].Capacity = O.WriteQueue;
  for (Queue &Q : Queues)
    Q.Of.resize(Banks.size());
}

/// Whether it is ever sent.
bool Controller::isIssued(Command C) const {
  const bool ByBank = O.Refresh == ControllerOptions::RefreshBy::Bank;
  return C == Command::RefreshBank ? ByBank : !ByBank || !isOfRank(C);
}

/// A constraint is between the last ticks of two commands.
void Controller::addSteps(const Constraint &C) {
  const uint32_t Later = LaterTicks[size_t(C.To)];
  const uint32_t Ticks = C.Ticks - std::min(C.Ticks, Later);
  if (C.Window != 1) {
    Window = C.Window;
    WindowTicks = Ticks;
    return;
  }
  const auto To = static_cast<uint32_t>(C.To);
  if (C.Within == Scope::Bank) {
    OfBank[size_t(C.From)].push_back({To, Ticks});
    return;
  }
  for (uint32_t From = 0; From != groups(); ++From) {
    std::vector<Step> &Steps = OfOthers[size_t(C.From) * groups() + From];
    const uint32_t FromRank = From / T.BankGroups;
    const auto IsMeant = [&](uint32_t Rank) {
      return C.Within == Scope::Channel ||
             (C.Within == Scope::OtherRanks) == (Rank != FromRank);
    };
    if (isOfRank(C.To)) {
      for (uint32_t R = 0; R != T.Ranks; ++R)
        if (IsMeant(R))
          Steps.push_back({placeOfRank(R, C.To), Ticks});
      continue;
    }
    for (uint32_t G = 0; G != groups(); ++G)
      if (C.Within == Scope::BankGroup ? G == From : IsMeant(G / T.BankGroups))
        Steps.push_back({static_cast<uint32_t>(G * Commands) + To, Ticks});
  }
}

void Controller::submit(const Request &R) {
  assert(R.Where.Bank < Banks.size() && "a bank that the device has not");
  assert(R.At >= Told && "a request of the past");
  std::deque<Request> &Waiting = Queues[R.IsWrite].Waiting;
  const auto IsBefore = [](const Request &A, const Request &B) {
    return A.At != B.At ? A.At < B.At : A.Id < B.Id;
  };
  auto Position = Waiting.end();
  while (Position != Waiting.begin() && IsBefore(R, *(Position - 1)))
    --Position;
  Waiting.insert(Position, R);
  ++Unanswered;
}

uint32_t Controller::room(bool IsWrite) const {
  const Queue &Q = Queues[IsWrite];
  const uint64_t Lines = (Q.Capacity - Q.Bursts) / BurstsOfLine;
  return static_cast<uint32_t>(Lines - std::min(Lines, Q.Waiting.size()));
}

/// A request can lead to a command from the tick after its arrival on.
uint64_t Controller::nextTakenIn() const {
  uint64_t At = Never;
  for (const Queue &Q : Queues)
    if (!Q.Waiting.empty() && hasRoom(Q))
      At = std::min(At, std::max(Q.Waiting.front().At + 1, Now));
  return At;
}

uint64_t Controller::nextEvent() const {
  if (Unanswered == 0)
    return Never;
  if (!IsDecided)
    return Now;
  return std::min({Next.Begin, nextTakenIn(), NextRefresh});
}

void Controller::advance(uint64_t Until, std::vector<Reply> &Replies) {
  Told = Until;
  for (;;) {
    if (!IsDecided) {
      // What happens later may still meet requests of this tick's end.
      if (Now > Until)
        return;
      settle(Replies);
      decide();
      IsDecided = true;
    }
    const uint64_t Change = std::min(nextTakenIn(), NextRefresh);
    if (std::min(Change, Next.Begin) > Until)
      return;
    if (Change <= Next.Begin) {
      Now = Change;
      IsDecided = !settle(Replies);
    } else {
      issue(Replies);
      IsDecided = false;
    }
  }
}

/// Takes in what has come by now. Returns whether all must be weighed again;
/// what is decided has been weighed against the requests that came.
bool Controller::settle(std::vector<Reply> &Replies) {
  const bool WasDraining = IsDraining;
  bool Changes = nextTakenIn() <= Now && takeIn(Replies);
  Changes |= noteRefreshes();
  chooseQueue();
  return Changes || IsDraining != WasDraining;
}

//===----------------------------------------------------------------------===//
// What comes in
//===----------------------------------------------------------------------===//

bool Controller::takeIn(std::vector<Reply> &Replies) {
  bool Changes = false;
  for (;;) {
    Queue *First = nullptr;
    for (Queue &Q : Queues) {
      if (Q.Waiting.empty() || Q.Waiting.front().At >= Now || !hasRoom(Q))
        continue;
      const Request &R = Q.Waiting.front();
      if (!First || R.At < First->Waiting.front().At ||
          (R.At == First->Waiting.front().At &&
           R.Id < First->Waiting.front().Id))
        First = &Q;
    }
    if (!First)
      return Changes;
    Changes |= enter(First->Waiting.front(), Replies);
    First->Waiting.pop_front();
  }
}

/// Whether a write of the line waits, so that a read must not overtake it.
bool Controller::isBeingWritten(const Request &R) const {
  for (uint32_t E = Queues[1].Of[R.Where.Bank].First; E != None;
       E = Entries[E].Next)
    if (Entries[E].Line == R.Line)
      return true;
  return std::ranges::any_of(Promoted, [&](uint32_t E) {
    return Entries[E].IsWrite && Entries[E].Line == R.Line;
  });
}

/// Returns whether all must be weighed again because of it. Behind others of
/// its kind at its bank it changes nothing.
bool Controller::enter(const Request &R, std::vector<Reply> &Replies) {
  if (!R.IsWrite && isBeingWritten(R)) {
    ++Counted.Forwarded;
    --Unanswered;
    Replies.push_back({R.Id, Now, Now, false});
    return false;
  }
  if (Free.empty()) {
    Free.push_back(static_cast<uint32_t>(Entries.size()));
    Entries.emplace_back();
  }
  const uint32_t Which = Free.back();
  Free.pop_back();
  Queue &Q = Queues[R.IsWrite];
  BankQueue &L = Q.Of[R.Where.Bank];
  const auto Bursts = static_cast<uint16_t>(BurstsOfLine);
  const uint64_t Order = NextOrder++;
  Entries[Which] = {Order,  R.Id,   R.Line, R.Where.Bank, R.Where.Row, None,
                    L.Last, Bursts, Bursts, R.IsWrite,    false};
  (L.First == None ? L.First : Entries[L.Last].Next) = Which;
  L.Last = Which;
  Q.Bursts += BurstsOfLine;
  if (!R.IsWrite)
    ReadsOut += BurstsOfLine;
  const Bank &B = Banks[R.Where.Bank];
  const bool IsHit = B.IsOpen && B.Row == R.Where.Row;
  if ((IsHit ? L.Hit : L.Miss) != None)
    return false;
  if (IsHit)
    setHit(Q, R.Where.Bank, Which);
  else
    setMiss(Q, R.Where.Bank, Which);
  if (!IsDecided || O.CloseRowAfter != Never || (IsHit && B.Uses > O.RowHitCap))
    return true;
  if (R.IsWrite != IsDraining || (Blocked >> R.Where.Bank & 1))
    return false;
  const Command What = nextOf(Entries[Which]);
  BusReady[size_t(What)] = std::max(BusReady[size_t(What)], Now);
  consider(ready(What, B), Order, OfQueue, What, R.Where.Bank, Which, None);
  return false;
}

bool Controller::noteRefreshes() {
  if (NextRefresh > Now)
    return false;
  NextRefresh = Never;
  for (Rank &R : Ranks) {
    for (; R.NextRefresh <= Now; R.NextRefresh += RefreshInterval) {
      ++R.RefreshesDue;
      ++RefreshesDue;
    }
    NextRefresh = std::min(NextRefresh, R.NextRefresh);
  }
  return true;
}

/// Reads go first until many writes wait or no read does.
void Controller::chooseQueue() {
  const uint32_t Reads = Queues[0].Bursts;
  const uint32_t Writes = Queues[1].Bursts;
  if (!IsDraining) {
    if (Owed == 0 && (Reads == 0 || Writes > Above)) {
      IsDraining = true;
      Drained = 0;
      Counted.Drains += Writes != 0;
    }
  } else if (Drained >= O.MostDrained && ReadsOut != 0) {
    // Whoever keeps the write queue filled must not stop all reads.
    IsDraining = false;
    Owed = ReadsOut;
  } else if (Reads != 0) {
    IsDraining = Writes >= Below;
  }
}

//===----------------------------------------------------------------------===//
// What is decided
//===----------------------------------------------------------------------===//

inline uint64_t Controller::ready(Command C, const Bank &B) const {
  return std::max(B.Next[size_t(C)], Common[B.Common + size_t(C)]);
}

inline Command Controller::nextOf(const Entry &E) const {
  const Bank &B = Banks[E.Bank];
  if (!B.IsOpen)
    return Command::Activate;
  if (B.Row != E.Row)
    return Command::Precharge;
  return E.IsWrite ? Command::Write : Command::Read;
}

/// Keeps the best: what can be begun first, of those who goes first.
inline void Controller::consider(uint64_t Ready, uint64_t Order, uint8_t Class,
                                 Command What, uint32_t Bank, uint32_t Entry,
                                 uint32_t PlacePromoted) {
  const uint64_t Begin = std::max(Ready, BusReady[size_t(What)]);
  if (Begin > Next.Begin)
    return;
  if (Begin == Next.Begin &&
      (Class != Next.Class ? Class > Next.Class : Order >= Next.Order))
    return;
  Next = {Begin, Order, Class, What, Bank, Entry, PlacePromoted};
}

void Controller::decide() {
  Next.Begin = Next.Order = Never;
  const uint64_t Row = std::max(Now, BusFree[0]);
  BusReady.fill(Row);
  BusReady[size_t(Command::Read)] = BusReady[size_t(Command::Write)] =
      T.HasColumnBus ? std::max(Now, BusFree[1]) : Row;
  if (!Promoted.empty())
    considerPromoted();
  Blocked = 0;
  if (RefreshesDue != 0)
    considerRefreshes();
  considerQueue();
  if (O.CloseRowAfter != Never)
    considerClosing();
}

void Controller::considerPromoted() {
  uint64_t Oldest = Never;
  uint32_t AtCap = None;
  for (uint32_t P = 0; P != Promoted.size(); ++P) {
    const Entry &E = Entries[Promoted[P]];
    const Bank &B = Banks[E.Bank];
    const Command What = nextOf(E);
    const bool IsCapped = isColumn(What) && B.Uses > O.RowHitCap;
    if (E.Order < Oldest) {
      Oldest = E.Order;
      AtCap = IsCapped ? P : None;
    }
    if (!IsCapped)
      consider(ready(What, B), E.Order, OfPromoted, What, E.Bank, Promoted[P],
               P);
  }
  if (AtCap == None)
    return;
  const Entry &E = Entries[Promoted[AtCap]];
  const Command What = nextOf(E);
  consider(ready(What, Banks[E.Bank]), Last, OfPromoted, What, E.Bank,
           Promoted[AtCap], AtCap);
}

/// The banks concerned take up no further requests.
void Controller::considerRefreshes() {
  for (uint32_t R = 0; R != Ranks.size(); ++R) {
    if (Ranks[R].RefreshesDue == 0)
      continue;
    const uint32_t First = R * T.banksPerRank();
    if (O.Refresh == ControllerOptions::RefreshBy::Bank) {
      const uint32_t Which = First + Ranks[R].BankToRefresh;
      const Bank &B = Banks[Which];
      const Command What = B.IsOpen ? Command::Precharge : Command::RefreshBank;
      consider(ready(What, B), R, OfRefresh, What, Which, None, None);
      Blocked |= uint64_t{1} << Which;
      continue;
    }
    const uint64_t All = (~uint64_t{0} >> (64 - T.banksPerRank())) << First;
    const Command What = Open & All ? Command::PrechargeAll : Command::Refresh;
    consider(Common[placeOfRank(R, What)], R, OfRefresh, What, First, None,
             None);
    Blocked |= All;
  }
}

void Controller::considerQueue() {
  const Queue &Q = Queues[IsDraining];
  const Command Column = activeColumn();
  // A controller spends its time here, so that a candidate is one number: when
  // it can begin, and below that its order.
  constexpr unsigned OrderBits = 38;
  uint64_t Best = Never;
  uint32_t Which = None;
  const auto Weigh = [&](uint32_t Of, uint64_t Ready, Command What,
                         uint64_t Order) {
    const uint64_t Begin =
        std::max({Ready, Common[Banks[Of].Common + size_t(What)],
                  BusReady[size_t(What)]});
    const uint64_t Key = (Begin - Now) << OrderBits | Order;
    Which = Key < Best ? Of : Which;
    Best = std::min(Best, Key);
  };
  for (uint64_t Left = Q.Hits & ~Blocked & ~Capped; Left; Left &= Left - 1) {
    const auto Of = static_cast<uint32_t>(std::countr_zero(Left));
    Weigh(Of, Banks[Of].Next[size_t(Column)], Column, Q.Of[Of].HitOrder);
  }
  const uint64_t BestHit = Best;
  for (uint64_t Left = Q.Misses & Open & ~Blocked; Left; Left &= Left - 1) {
    const auto Of = static_cast<uint32_t>(std::countr_zero(Left));
    Weigh(Of, Banks[Of].Next[size_t(Command::Precharge)], Command::Precharge,
          Q.Of[Of].MissOrder);
  }
  for (uint64_t Left = Q.Misses & ~Open & ~Blocked; Left; Left &= Left - 1) {
    const auto Of = static_cast<uint32_t>(std::countr_zero(Left));
    Weigh(Of, Banks[Of].Next[size_t(Command::Activate)], Command::Activate,
          Q.Of[Of].MissOrder);
  }
  if (Which != None) {
    const bool IsHit = Best == BestHit;
    const uint32_t Entry = IsHit ? Q.Of[Which].Hit : Q.Of[Which].Miss;
    const uint64_t Begin = Now + (Best >> OrderBits);
    consider(Begin, Entries[Entry].Order, OfQueue, nextOf(Entries[Entry]),
             Which, Entry, None);
  }
  if (Q.Hits & Capped & ~Blocked)
    considerCapped(Q);
}

/// A row beyond its cap is used only for the oldest request of its bank group.
void Controller::considerCapped(const Queue &Q) {
  const Command Column = activeColumn();
  for (uint32_t G = 0; G != groups(); ++G) {
    const uint64_t OfGroup = (~uint64_t{0} >> (64 - T.BanksPerGroup))
                             << (G * T.BanksPerGroup);
    uint64_t Oldest = Never;
    uint32_t Hit = None;
    for (uint64_t Left = (Q.Hits | Q.Misses) & ~Blocked & OfGroup; Left;
         Left &= Left - 1) {
      const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
      const BankQueue &L = Q.Of[Which];
      if (L.Hit != None && L.HitOrder < Oldest) {
        Oldest = L.HitOrder;
        Hit = Capped >> Which & 1 ? Which : None;
      }
      if (L.Miss != None && L.MissOrder < Oldest) {
        Oldest = L.MissOrder;
        Hit = None;
      }
    }
    if (Hit != None)
      consider(ready(Column, Banks[Hit]), Oldest, OfCapped, Column, Hit,
               Q.Of[Hit].Hit, None);
  }
}

void Controller::considerClosing() {
  uint64_t Wanted = Blocked;
  for (const uint32_t E : Promoted)
    Wanted |= uint64_t{1} << Entries[E].Bank;
  for (uint64_t Left = Open & ~Wanted; Left; Left &= Left - 1) {
    const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
    if (Queues[0].Of[Which].Hit != None || Queues[1].Of[Which].Hit != None)
      continue;
    const Bank &B = Banks[Which];
    const uint64_t Unused =
        O.CloseRowAfter -
        std::min<uint64_t>(O.CloseRowAfter,
                           LaterTicks[size_t(Command::Precharge)]);
    consider(std::max(ready(Command::Precharge, B), B.LastUse + Unused), Which,
             OfClosing, Command::Precharge, Which, None, None);
  }
}

//===----------------------------------------------------------------------===//
// What is done
//===----------------------------------------------------------------------===//

/// Writes down what \p C, issued at \p At to \p B or its rank, forbids.
void Controller::restrict(Command C, Bank &B, uint64_t At) {
  for (const Step &S : OfBank[size_t(C)])
    B.Next[S.To] = std::max(B.Next[S.To], At + S.Ticks);
  for (const Step &S : OfOthers[size_t(C) * groups() + B.Group])
    Common[S.To] = std::max(Common[S.To], At + S.Ticks);
  if (C != Command::Activate)
    return;
  Rank &R = Ranks[B.Rank];
  R.Activations[R.OldestActivation] = At;
  if (++R.OldestActivation == Window)
    R.OldestActivation = 0;
  if (const uint64_t Oldest = R.Activations[R.OldestActivation];
      Oldest != Never)
    for (uint32_t G = 0; G != T.BankGroups; ++G) {
      uint64_t &Allowed = Common[(B.Rank * T.BankGroups + G) * Commands +
                                 size_t(Command::Activate)];
      Allowed = std::max(Allowed, Oldest + WindowTicks);
    }
}

void Controller::issue(std::vector<Reply> &Replies) {
  const Choice C = Next;
  const uint64_t At = C.Begin + LaterTicks[size_t(C.What)];
  Bank &B = Banks[C.Bank];
  restrict(C.What, B, At);
  BusFree[BusOf[size_t(C.What)]] = At + 1;
  // With two buses another command may begin at the same tick.
  Now = T.HasColumnBus ? C.Begin : At + 1;
  if (Recorded)
    Recorded->push_back(
        {At,
         C.What,
         {C.Bank, C.What == Command::Activate ? Entries[C.Entry].Row : B.Row}});
  if (C.Entry != None && !Entries[C.Entry].IsSeen) {
    Entries[C.Entry].IsSeen = true;
    ++(C.What == Command::Activate    ? Counted.RowMisses
       : C.What == Command::Precharge ? Counted.RowConflicts
                                      : Counted.RowHits);
  }

  switch (C.What) {
  case Command::Activate:
    if (C.PlacePromoted == None)
      promote(C.Entry);
    open(C.Bank, Entries[C.Entry].Row, At);
    break;
  case Command::Precharge:
    close(C.Bank);
    break;
  case Command::PrechargeAll:
    for (uint32_t N = 0; N != T.banksPerRank(); ++N)
      close(C.Bank + N);
    break;
  case Command::Read:
  case Command::Write:
    access(At, Replies);
    break;
  case Command::RefreshBank:
    Ranks[B.Rank].BankToRefresh =
        (Ranks[B.Rank].BankToRefresh + 1) % T.banksPerRank();
    [[fallthrough]];
  case Command::Refresh:
    --Ranks[B.Rank].RefreshesDue;
    --RefreshesDue;
    ++Counted.Refreshes;
    break;
  case Command::Count:
    assert(false && "nothing was decided");
  }
}

/// The burst for which a row is opened is taken out of its queue, so that
/// nobody closes the row before it.
void Controller::promote(uint32_t Which) {
  Promoted.push_back(Which);
  leaveQueue(Which);
}

void Controller::access(uint64_t At, std::vector<Reply> &Replies) {
  const uint32_t Which = Next.Entry;
  if (Next.PlacePromoted == None)
    leaveQueue(Which);
  else
    Promoted.erase(Promoted.begin() + Next.PlacePromoted);
  Entry &E = Entries[Which];
  Bank &B = Banks[E.Bank];
  if (++B.Uses > O.RowHitCap)
    Capped |= uint64_t{1} << E.Bank;
  B.LastUse = At;
  ++(E.IsWrite ? Counted.Writes : Counted.Reads);
  Counted.BusTicks += T.BurstTicks;
  if (E.IsWrite) {
    Drained += ReadsOut != 0;
  } else {
    --ReadsOut;
    Owed -= Owed != 0;
  }
  if (--E.Left != 0)
    return;
  const uint32_t Latency = E.IsWrite ? T.WriteLatency : T.ReadLatency;
  Replies.push_back({E.Id, Next.Begin, At + Latency + T.BurstTicks, E.IsWrite});
  --Unanswered;
  Free.push_back(Which);
}

void Controller::open(uint32_t Which, uint32_t Row, uint64_t At) {
  Bank &B = Banks[Which];
  B.IsOpen = true;
  B.Row = Row;
  B.Uses = 0;
  B.LastUse = At;
  Open |= uint64_t{1} << Which;
  Capped &= ~(uint64_t{1} << Which);
  ++Counted.Activations;
  for (Queue &Q : Queues)
    findFirsts(Q, Which);
}

void Controller::close(uint32_t Which) {
  Banks[Which].IsOpen = false;
  Open &= ~(uint64_t{1} << Which);
  for (Queue &Q : Queues)
    findFirsts(Q, Which);
}

inline void Controller::setHit(Queue &Q, uint32_t Which, uint32_t Entry) {
  const uint64_t Bit = uint64_t{1} << Which;
  Q.Of[Which].Hit = Entry;
  Q.Hits &= ~Bit;
  if (Entry == None)
    return;
  Q.Hits |= Bit;
  Q.Of[Which].HitOrder = Entries[Entry].Order;
}

inline void Controller::setMiss(Queue &Q, uint32_t Which, uint32_t Entry) {
  const uint64_t Bit = uint64_t{1} << Which;
  Q.Of[Which].Miss = Entry;
  Q.Misses &= ~Bit;
  if (Entry == None)
    return;
  Q.Misses |= Bit;
  Q.Of[Which].MissOrder = Entries[Entry].Order;
}

void Controller::findFirsts(Queue &Q, uint32_t Which) {
  const BankQueue &L = Q.Of[Which];
  if (L.First == None)
    return;
  const Bank &B = Banks[Which];
  uint32_t Hit = None, Miss = None;
  for (uint32_t E = L.First;
       E != None && (Miss == None || (B.IsOpen && Hit == None));
       E = Entries[E].Next) {
    const bool IsHit = B.IsOpen && Entries[E].Row == B.Row;
    if (uint32_t &First = IsHit ? Hit : Miss; First == None)
      First = E;
  }
  setHit(Q, Which, Hit);
  setMiss(Q, Which, Miss);
}

/// One burst of an entry is taken up: the oldest hit of its bank, or one whose
/// row is about to be opened, which finds the firsts anew.
void Controller::leaveQueue(uint32_t Which) {
  Entry &E = Entries[Which];
  Queue &Q = Queues[E.IsWrite];
  --Q.Bursts;
  if (--E.Queued != 0)
    return;
  BankQueue &L = Q.Of[E.Bank];
  (E.Previous == None ? L.First : Entries[E.Previous].Next) = E.Next;
  (E.Next == None ? L.Last : Entries[E.Next].Previous) = E.Previous;
  if (L.Miss == Which)
    setMiss(Q, E.Bank, None);
  if (L.Hit != Which)
    return;
  uint32_t Hit = E.Next;
  while (Hit != None && Entries[Hit].Row != E.Row)
    Hit = Entries[Hit].Next;
  setHit(Q, E.Bank, Hit);
}

} // namespace vorion::isasim::dram
