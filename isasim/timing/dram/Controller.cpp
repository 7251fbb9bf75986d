#include "timing/dram/Controller.h"

#include <algorithm>
#include <cassert>
#include <fmt/format.h>

namespace vorion::isasim::dram {

namespace {

uint32_t burstsOfLine(const TimingTable &Table,
                      const ControllerOptions &Options) {
  return (Options.LineBytes + Table.BurstBytes - 1) / Table.BurstBytes;
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
    return Fail(fmt::format(
        "a queue has {} entries for bursts, expected the {} bursts of a line",
        std::min(Options.ReadQueue, Options.WriteQueue), Bursts));
  if (Options.DrainAbove > 100 || Options.DrainBelow > Options.DrainAbove)
    return Fail(
        fmt::format("writes are drained above {} % until below {} %, expected "
                    "at most 100 and the lower threshold not above the upper",
                    Options.DrainAbove, Options.DrainBelow));
  if (Options.MostDrained == 0)
    return Fail("most_drained is 0, expected at least one burst");
  if (Options.Refresh == ControllerOptions::RefreshBy::Bank &&
      Table.BankRefreshInterval == 0)
    return Fail(fmt::format(
        "{} has no per-bank refresh: its table has no bank_refresh_interval",
        Table.Standard));
  return Success{};
}

Controller::Controller(const TimingTable &DeviceTable,
                       const ControllerOptions &Chosen,
                       std::unique_ptr<DramScheduler> Plugged)
    : Table(DeviceTable), Options(Chosen), Schedule({}, std::move(Plugged)),
      CapsRows(Schedule.ask([](const auto &S) { return S.capsRows(); })),
      BurstsOfLine(burstsOfLine(Table, Options)),
      Above(Options.DrainAbove * Options.WriteQueue / 100),
      // An empty queue ends a drain, however small it is.
      Below(std::max(1U, Options.DrainBelow * Options.WriteQueue / 100)),
      StepsElsewhere(groups() * Commands), Banks(Table.banks()),
      Common((groups() + Table.Ranks) * Commands), Ranks(Table.Ranks) {
  for (size_t C = 0; C != Commands; ++C)
    LaterTicks[C] = Table.CommandTicks[C] - 1;
  for (const Constraint &C : Table.Constraints)
    if (isIssued(C.To))
      addSteps(C);
  BusOf[size_t(Command::Read)] = BusOf[size_t(Command::Write)] =
      Table.HasColumnBus;
  for (uint32_t B = 0; B != Banks.size(); ++B) {
    Banks[B].Group = B / Table.BanksPerGroup;
    Banks[B].Rank = B / Table.banksPerRank();
    Banks[B].Common = static_cast<uint32_t>(Banks[B].Group * Commands);
  }
  if (Options.Refresh == ControllerOptions::RefreshBy::Rank)
    RefreshInterval = Table.RefreshInterval;
  if (Options.Refresh == ControllerOptions::RefreshBy::Bank)
    RefreshInterval = Table.BankRefreshInterval;
  for (uint32_t R = 0; R != Table.Ranks; ++R) {
    Ranks[R].Activations.assign(Window, Never);
    // Ranks take turns, so that they are not refreshed at once.
    if (RefreshInterval != Never)
      Ranks[R].NextRefresh =
          RefreshInterval + R * RefreshInterval / Table.Ranks;
  }
  for (const Rank &R : Ranks)
    NextRefresh = std::min(NextRefresh, R.NextRefresh);
  Queues[0].Capacity = Options.ReadQueue;
  Queues[1].Capacity = Options.WriteQueue;
  for (Queue &Q : Queues)
    Q.Banks.resize(Banks.size());
}

/// Whether it is ever sent.
bool Controller::isIssued(Command C) const {
  const bool ByBank = Options.Refresh == ControllerOptions::RefreshBy::Bank;
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
    StepsInBank[size_t(C.From)].push_back({To, Ticks});
    return;
  }
  for (uint32_t From = 0; From != groups(); ++From) {
    std::vector<Step> &Steps = StepsElsewhere[size_t(C.From) * groups() + From];
    const uint32_t FromRank = From / Table.BankGroups;
    const auto IsMeant = [&](uint32_t Rank) {
      return C.Within == Scope::Channel ||
             (C.Within == Scope::OtherRanks) == (Rank != FromRank);
    };
    if (isOfRank(C.To)) {
      for (uint32_t R = 0; R != Table.Ranks; ++R)
        if (IsMeant(R))
          Steps.push_back({placeOfRank(R, C.To), Ticks});
      continue;
    }
    for (uint32_t G = 0; G != groups(); ++G)
      if (C.Within == Scope::BankGroup ? G == From
                                       : IsMeant(G / Table.BankGroups))
        Steps.push_back({static_cast<uint32_t>(G * Commands) + To, Ticks});
  }
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
  AdvancedTo = Until;
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
// What is done
//===----------------------------------------------------------------------===//

/// Writes down what \p C, issued at \p At to \p B or its rank, forbids.
void Controller::restrict(Command C, Bank &B, uint64_t At) {
  for (const Step &S : StepsInBank[size_t(C)])
    B.Next[S.To] = std::max(B.Next[S.To], At + S.Ticks);
  for (const Step &S : StepsElsewhere[size_t(C) * groups() + B.Group])
    Common[S.To] = std::max(Common[S.To], At + S.Ticks);
  if (C != Command::Activate)
    return;
  Rank &R = Ranks[B.Rank];
  R.Activations[R.OldestActivation] = At;
  if (++R.OldestActivation == Window)
    R.OldestActivation = 0;
  if (const uint64_t Oldest = R.Activations[R.OldestActivation];
      Oldest != Never)
    for (uint32_t G = 0; G != Table.BankGroups; ++G) {
      uint64_t &Allowed = Common[(B.Rank * Table.BankGroups + G) * Commands +
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
  Now = Table.HasColumnBus ? C.Begin : At + 1;
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
    promote(C.Entry);
    open(C.Bank, Entries[C.Entry].Row, At);
    if (Table.SecondActivateWithin)
      Half = {At + 1, At + Table.SecondActivateWithin, C.Bank};
    break;
  case Command::Activate2:
    Half.reset();
    break;
  case Command::Precharge:
    close(C.Bank);
    break;
  case Command::PrechargeAll:
    for (uint32_t N = 0; N != Table.banksPerRank(); ++N)
      close(C.Bank + N);
    break;
  case Command::Read:
  case Command::Write:
    access(At, Replies);
    break;
  case Command::RefreshBank:
    Ranks[B.Rank].BankToRefresh =
        (Ranks[B.Rank].BankToRefresh + 1) % Table.banksPerRank();
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

/// The burst for which a row is opened is taken out of its queue. Nobody closes
/// the row before it.
void Controller::promote(uint32_t Which) {
  Promoted.push_back(Which);
  Opened |= uint64_t{1} << Entries[Which].Bank;
  leaveQueue(Which);
}

void Controller::access(uint64_t At, std::vector<Reply> &Replies) {
  const uint32_t Which = Next.Entry;
  Entry &E = Entries[Which];
  if (Next.PlacePromoted == None) {
    leaveQueue(Which);
  } else {
    Promoted.erase(Promoted.begin() + Next.PlacePromoted);
    Opened &= ~(uint64_t{1} << E.Bank);
  }
  Bank &B = Banks[E.Bank];
  if (++B.Uses > Options.RowHitCap)
    Capped |= uint64_t{1} << E.Bank;
  B.LastUse = At;
  ++(E.IsWrite ? Counted.Writes : Counted.Reads);
  Counted.BusTicks += Table.BurstTicks;
  if (E.IsWrite) {
    Drained += ReadsOut != 0;
  } else {
    --ReadsOut;
    Owed -= Owed != 0;
  }
  if (--E.Left != 0)
    return;
  const uint32_t Latency = E.IsWrite ? Table.WriteLatency : Table.ReadLatency;
  Replies.push_back(
      {E.Id, Next.Begin, At + Latency + Table.BurstTicks, E.IsWrite});
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

void Controller::setOldest(Queue &Q, uint32_t Bank, Kind Which,
                           uint32_t Entry) {
  const uint64_t Bit = uint64_t{1} << Bank;
  Q.Banks[Bank].OldestOf[Which].Entry = Entry;
  Q.BanksWith[Which] &= ~Bit;
  if (Entry == None)
    return;
  Q.BanksWith[Which] |= Bit;
  Q.Banks[Bank].OldestOf[Which].Order = Entries[Entry].Order;
}

void Controller::findFirsts(Queue &Q, uint32_t Which) {
  const BankQueue &L = Q.Banks[Which];
  if (L.First == None)
    return;
  const Bank &B = Banks[Which];
  std::array<uint32_t, Kinds> Found = {None, None};
  for (uint32_t E = L.First;
       E != None && (Found[Miss] == None || (B.IsOpen && Found[Hit] == None));
       E = Entries[E].Next) {
    const bool IsHit = B.IsOpen && Entries[E].Row == B.Row;
    if (uint32_t &First = Found[IsHit ? Hit : Miss]; First == None)
      First = E;
  }
  for (const Kind Each : {Hit, Miss})
    setOldest(Q, Which, Each, Found[Each]);
}

/// One burst of an entry is taken up: the oldest hit of its bank, or one whose
/// row is about to be opened, which finds the firsts anew.
void Controller::leaveQueue(uint32_t Which) {
  Entry &E = Entries[Which];
  Queue &Q = Queues[E.IsWrite];
  --Q.Bursts;
  if (--E.Queued != 0)
    return;
  BankQueue &L = Q.Banks[E.Bank];
  (E.Previous == None ? L.First : Entries[E.Previous].Next) = E.Next;
  (E.Next == None ? L.Last : Entries[E.Next].Previous) = E.Previous;
  if (L.OldestOf[Miss].Entry == Which)
    setOldest(Q, E.Bank, Miss, None);
  if (L.OldestOf[Hit].Entry != Which)
    return;
  uint32_t Younger = E.Next;
  while (Younger != None && Entries[Younger].Row != E.Row)
    Younger = Entries[Younger].Next;
  setOldest(Q, E.Bank, Hit, Younger);
}

} // namespace vorion::isasim::dram
