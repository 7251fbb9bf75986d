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
      Below(std::max(1U, O.DrainBelow * O.WriteQueue / 100)), Banks(T.banks()),
      Groups(size_t{T.Ranks} * T.BankGroups), Ranks(T.Ranks) {
  for (const Constraint &C : T.Constraints) {
    if (C.Window == 1) {
      Steps[size_t(C.From)][size_t(C.Within)].push_back({C.To, C.Ticks});
      continue;
    }
    Window = C.Window;
    WindowTicks = C.Ticks;
  }
  for (size_t C = 0; C != Commands; ++C)
    LaterTicks[C] = T.CommandTicks[C] - 1;
  BusOf[size_t(Command::Read)] = BusOf[size_t(Command::Write)] = T.HasColumnBus;
  for (uint32_t B = 0; B != Banks.size(); ++B) {
    Banks[B].Group = B / T.BanksPerGroup;
    Banks[B].Rank = B / T.banksPerRank();
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
  Queues[0].Capacity = O.ReadQueue;
  Queues[1].Capacity = O.WriteQueue;
  for (Queue &Q : Queues)
    Q.Of.resize(Banks.size());
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

uint64_t Controller::nextRefresh() const {
  uint64_t At = Never;
  for (const Rank &R : Ranks)
    At = std::min(At, R.NextRefresh);
  return At;
}

uint64_t Controller::nextEvent() const {
  if (Unanswered == 0)
    return Never;
  if (!IsDecided)
    return Now;
  return std::min({Next.Begin, nextTakenIn(), nextRefresh()});
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
    const uint64_t Change = std::min(nextTakenIn(), nextRefresh());
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

/// Takes in what has come by now. Returns whether that may change what is
/// decided.
bool Controller::settle(std::vector<Reply> &Replies) {
  const bool WasDraining = IsDraining;
  bool Changes = takeIn(Replies);
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

/// Returns whether it is the first of its kind at its bank: others stand behind
/// what was weighed already.
bool Controller::enter(const Request &R, std::vector<Reply> &Replies) {
  if (!R.IsWrite && isBeingWritten(R)) {
    ++Counted.Forwarded;
    --Unanswered;
    Replies.push_back({R.Id, Now, false});
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
  Entries[Which] = {NextOrder++, R.Id,      R.Line, R.Where.Bank,
                    R.Where.Row, None,      L.Last, Bursts,
                    Bursts,      R.IsWrite, false};
  (L.First == None ? L.First : Entries[L.Last].Next) = Which;
  L.Last = Which;
  Q.Banks |= uint64_t{1} << R.Where.Bank;
  Q.Bursts += BurstsOfLine;
  if (!R.IsWrite)
    ReadsOut += BurstsOfLine;
  const Bank &B = Banks[R.Where.Bank];
  const bool IsHit = B.IsOpen && B.Row == R.Where.Row;
  uint32_t &First = IsHit ? L.Hit : L.Miss;
  if (First != None)
    return false;
  First = Which;
  (IsHit ? L.HitOrder : L.MissOrder) = Entries[Which].Order;
  return true;
}

bool Controller::noteRefreshes() {
  bool Changes = false;
  for (Rank &R : Ranks)
    for (; R.NextRefresh <= Now; R.NextRefresh += RefreshInterval) {
      ++R.RefreshesDue;
      Changes = true;
    }
  return Changes;
}

/// Reads go first until many writes wait or no read does.
void Controller::chooseQueue() {
  const uint32_t Reads = Queues[0].Bursts;
  const uint32_t Writes = Queues[1].Bursts;
  if (!IsDraining) {
    if (Owed == 0 && (Reads == 0 || Writes > Above)) {
      IsDraining = true;
      Drained = 0;
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

uint64_t Controller::ready(Command C, const Bank &B) const {
  return std::max(B.Next[size_t(C)], Groups[B.Group][size_t(C)]);
}

/// Keeps the best: what can be begun first, of those who goes first.
inline void Controller::consider(uint64_t Ready, uint64_t Order, uint8_t Class,
                                 Command What, uint32_t Bank, uint32_t Entry,
                                 uint32_t PlacePromoted) {
  const uint64_t More = LaterTicks[size_t(What)];
  const uint64_t Begin =
      std::max(Ready - std::min(Ready, More), Earliest[size_t(What)]);
  if (Begin > Next.Begin)
    return;
  if (Begin == Next.Begin &&
      (Class != Next.Class ? Class > Next.Class : Order >= Next.Order))
    return;
  Next = {Begin, Order, Class, What, Bank, Entry, PlacePromoted};
}

void Controller::decide() {
  Next = {};
  for (size_t C = 0; C != Commands; ++C)
    Earliest[C] = std::max(Now, BusFree[BusOf[C]]);
  considerPromoted();
  const uint64_t Blocked = considerRefreshes();
  considerQueue(Queues[IsDraining], IsDraining ? Command::Write : Command::Read,
                Blocked);
  if (O.CloseRowAfter != Never)
    considerClosing(Blocked);
}

void Controller::considerPromoted() {
  uint64_t Oldest = Never;
  uint32_t Capped = None;
  for (uint32_t P = 0; P != Promoted.size(); ++P) {
    const Entry &E = Entries[Promoted[P]];
    const Bank &B = Banks[E.Bank];
    const bool IsHit = B.IsOpen && B.Row == E.Row;
    const Command What = IsHit      ? E.IsWrite ? Command::Write : Command::Read
                         : B.IsOpen ? Command::Precharge
                                    : Command::Activate;
    const bool IsCapped = IsHit && B.Uses > O.RowHitCap;
    if (E.Order < Oldest) {
      Oldest = E.Order;
      Capped = IsCapped ? P : None;
    }
    if (!IsCapped)
      consider(ready(What, B), E.Order, OfPromoted, What, E.Bank, Promoted[P],
               P);
  }
  if (Capped == None)
    return;
  const Entry &E = Entries[Promoted[Capped]];
  const Command What = E.IsWrite ? Command::Write : Command::Read;
  consider(ready(What, Banks[E.Bank]), Last, OfPromoted, What, E.Bank,
           Promoted[Capped], Capped);
}

/// Returns the banks that take up no further requests.
uint64_t Controller::considerRefreshes() {
  uint64_t Blocked = 0;
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
    consider(Ranks[R].Next[size_t(What)], R, OfRefresh, What, First, None,
             None);
    Blocked |= All;
  }
  return Blocked;
}

void Controller::considerQueue(const Queue &Q, Command Column,
                               uint64_t Blocked) {
  bool AnyCapped = false;
  for (uint64_t Left = Q.Banks & ~Blocked; Left; Left &= Left - 1) {
    const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
    const Bank &B = Banks[Which];
    const BankQueue &L = Q.Of[Which];
    if (L.Hit != None) {
      if (B.Uses > O.RowHitCap)
        AnyCapped = true;
      else
        consider(ready(Column, B), L.HitOrder, OfQueue, Column, Which, L.Hit,
                 None);
    }
    if (L.Miss != None) {
      const Command What = B.IsOpen ? Command::Precharge : Command::Activate;
      consider(ready(What, B), L.MissOrder, OfQueue, What, Which, L.Miss, None);
    }
  }
  if (AnyCapped)
    considerCapped(Q, Column, Blocked);
}

/// A row beyond its cap is used only for the oldest request of its bank group.
void Controller::considerCapped(const Queue &Q, Command Column,
                                uint64_t Blocked) {
  for (uint32_t G = 0; G != Groups.size(); ++G) {
    const uint64_t OfGroup = (~uint64_t{0} >> (64 - T.BanksPerGroup))
                             << (G * T.BanksPerGroup);
    uint64_t Oldest = Never;
    uint32_t Hit = None;
    for (uint64_t Left = Q.Banks & ~Blocked & OfGroup; Left; Left &= Left - 1) {
      const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
      const BankQueue &L = Q.Of[Which];
      if (L.Hit != None && L.HitOrder < Oldest) {
        Oldest = L.HitOrder;
        Hit = Banks[Which].Uses > O.RowHitCap ? Which : None;
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

void Controller::considerClosing(uint64_t Blocked) {
  for (const uint32_t E : Promoted)
    Blocked |= uint64_t{1} << Entries[E].Bank;
  for (uint64_t Left = Open & ~Blocked; Left; Left &= Left - 1) {
    const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
    if (Queues[0].Of[Which].Hit != None || Queues[1].Of[Which].Hit != None)
      continue;
    const Bank &B = Banks[Which];
    consider(
        std::max(ready(Command::Precharge, B), B.LastUse + O.CloseRowAfter),
        Which, OfClosing, Command::Precharge, Which, None, None);
  }
}

//===----------------------------------------------------------------------===//
// What is done
//===----------------------------------------------------------------------===//

/// Writes down what \p C, issued at \p At to \p B or its rank, forbids.
void Controller::restrict(Command C, const Bank &B, Ticks &OfBank,
                          uint64_t At) {
  const auto &ByScope = Steps[size_t(C)];
  const auto Raise = [At](Ticks &Of, const Step &S) {
    Of[size_t(S.To)] = std::max(Of[size_t(S.To)], At + S.Ticks);
  };
  const auto RaiseRank = [&](uint32_t R, const Step &S) {
    if (isOfRank(S.To))
      return Raise(Ranks[R].Next, S);
    for (uint32_t G = 0; G != T.BankGroups; ++G)
      Raise(Groups[R * T.BankGroups + G], S);
  };
  for (const Step &S : ByScope[size_t(Scope::Bank)])
    Raise(OfBank, S);
  for (const Step &S : ByScope[size_t(Scope::BankGroup)])
    Raise(Groups[B.Group], S);
  for (const Step &S : ByScope[size_t(Scope::Rank)])
    RaiseRank(B.Rank, S);
  for (const Step &S : ByScope[size_t(Scope::Channel)])
    for (uint32_t R = 0; R != T.Ranks; ++R)
      RaiseRank(R, S);
  for (const Step &S : ByScope[size_t(Scope::OtherRanks)])
    for (uint32_t R = 0; R != T.Ranks; ++R)
      if (R != B.Rank)
        RaiseRank(R, S);
  if (C != Command::Activate)
    return;
  Rank &R = Ranks[B.Rank];
  R.Activations[R.OldestActivation] = At;
  R.OldestActivation = (R.OldestActivation + 1) % Window;
  if (const uint64_t Oldest = R.Activations[R.OldestActivation];
      Oldest != Never)
    for (uint32_t G = 0; G != T.BankGroups; ++G) {
      uint64_t &Allowed =
          Groups[B.Rank * T.BankGroups + G][size_t(Command::Activate)];
      Allowed = std::max(Allowed, Oldest + WindowTicks);
    }
}

void Controller::issue(std::vector<Reply> &Replies) {
  const Choice C = Next;
  const uint64_t At = C.Begin + LaterTicks[size_t(C.What)];
  Bank &B = Banks[C.Bank];
  restrict(C.What, B, B.Next, At);
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
  ++B.Uses;
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
  Replies.push_back({E.Id, At + Latency + T.BurstTicks, E.IsWrite});
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

void Controller::findFirsts(Queue &Q, uint32_t Which) {
  BankQueue &L = Q.Of[Which];
  const Bank &B = Banks[Which];
  L.Hit = L.Miss = None;
  for (uint32_t E = L.First;
       E != None && (L.Miss == None || (B.IsOpen && L.Hit == None));
       E = Entries[E].Next) {
    const bool IsHit = B.IsOpen && Entries[E].Row == B.Row;
    if (uint32_t &First = IsHit ? L.Hit : L.Miss; First == None) {
      First = E;
      (IsHit ? L.HitOrder : L.MissOrder) = Entries[E].Order;
    }
  }
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
  if (L.First == None)
    Q.Banks &= ~(uint64_t{1} << E.Bank);
  if (L.Hit != Which)
    return;
  L.Hit = E.Next;
  while (L.Hit != None && Entries[L.Hit].Row != E.Row)
    L.Hit = Entries[L.Hit].Next;
  if (L.Hit != None)
    L.HitOrder = Entries[L.Hit].Order;
}

} // namespace vorion::isasim::dram
