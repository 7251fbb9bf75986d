// What a controller takes in, and which command it chooses next.
#include "timing/dram/Controller.h"

#include <algorithm>
#include <bit>
#include <type_traits>

namespace vorion::isasim::dram {

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
    First->Waiting.pop();
  }
}

/// Whether a write of the line waits, so that a read must not overtake it.
bool Controller::isBeingWritten(const Request &R) const {
  for (uint32_t E = Queues[1].Banks[R.Where.Bank].First; E != None;
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
  const uint32_t Number = Free.back();
  Free.pop_back();
  Queue &Q = Queues[R.IsWrite];
  BankQueue &L = Q.Banks[R.Where.Bank];
  const auto Bursts = static_cast<uint16_t>(BurstsOfLine);
  const uint64_t Order = NextOrder++;
  Entries[Number] = {Order,  R.Id,   R.Line, R.Where.Bank, R.Where.Row, None,
                     L.Last, Bursts, Bursts, R.IsWrite,    false};
  (L.First == None ? L.First : Entries[L.Last].Next) = Number;
  L.Last = Number;
  Q.Bursts += BurstsOfLine;
  if (!R.IsWrite)
    ReadsOut += BurstsOfLine;
  const Bank &B = Banks[R.Where.Bank];
  const bool IsHit = B.IsOpen && B.Row == R.Where.Row;
  const Kind Which = IsHit ? Hit : Miss;
  if (L.OldestOf[Which].Entry != None)
    return false;
  setOldest(Q, R.Where.Bank, Which, Number);
  if (!IsDecided || Options.CloseRowAfter != Never || !Schedule.isOwn() ||
      (IsHit && B.Uses > Options.RowHitCap))
    return true;
  if (R.IsWrite != IsDraining || (Blocked >> R.Where.Bank & 1))
    return false;
  const Command What = nextOf(Entries[Number]);
  BusReady[size_t(What)] = std::max(BusReady[size_t(What)], Now);
  consider(ready(What, B), Order, Precedence::Queue, What, R.Where.Bank, Number,
           None);
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
  } else if (Drained >= Options.MostDrained && ReadsOut != 0) {
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
  return columnOf(E);
}

/// Keeps the best: what can be begun first, of those who goes first.
inline void Controller::consider(uint64_t Ready, uint64_t Order,
                                 Precedence Class, Command What, uint32_t Bank,
                                 uint32_t Entry, uint32_t PlacePromoted) {
  if ((Half && What == Command::Activate) ||
      (What == Command::Precharge && (Opened >> Bank & 1)))
    return;
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
      Table.HasColumnBus ? std::max(Now, BusFree[1]) : Row;
  if (!Promoted.empty())
    considerPromoted();
  Blocked = 0;
  if (RefreshesDue != 0)
    considerRefreshes();
  considerQueue();
  if (Options.CloseRowAfter != Never)
    considerClosing();
  if (Half)
    considerSecondActivate();
}

/// The second half of an activation takes a tick that nothing else wants, but
/// its last one in any case.
void Controller::considerSecondActivate() {
  constexpr Command What = Command::Activate2;
  const bool IsLast =
      std::max(Half->From, BusReady[size_t(What)]) >= Half->Until;
  consider(Half->From, 0,
           IsLast ? Precedence::Promoted : Precedence::SecondActivate, What,
           Half->Bank, None, None);
}

void Controller::considerPromoted() {
  uint64_t Oldest = Never;
  uint32_t AtCap = None;
  for (uint32_t P = 0; P != Promoted.size(); ++P) {
    const Entry &E = Entries[Promoted[P]];
    const Bank &B = Banks[E.Bank];
    const bool IsCapped = B.Uses > Options.RowHitCap;
    if (E.Order < Oldest) {
      Oldest = E.Order;
      AtCap = IsCapped ? P : None;
    }
    if (!IsCapped)
      consider(ready(columnOf(E), B), E.Order, Precedence::Promoted,
               columnOf(E), E.Bank, Promoted[P], P);
  }
  if (AtCap == None)
    return;
  const Entry &E = Entries[Promoted[AtCap]];
  consider(ready(columnOf(E), Banks[E.Bank]), Never, Precedence::Promoted,
           columnOf(E), E.Bank, Promoted[AtCap], AtCap);
}

/// The banks concerned take up no further requests. Opened rows are used first.
void Controller::considerRefreshes() {
  for (uint32_t R = 0; R != Ranks.size(); ++R) {
    if (Ranks[R].RefreshesDue == 0)
      continue;
    const uint32_t First = R * Table.banksPerRank();
    if (Options.Refresh == ControllerOptions::RefreshBy::Bank) {
      const uint32_t Which = First + Ranks[R].BankToRefresh;
      const Bank &B = Banks[Which];
      const Command What = B.IsOpen ? Command::Precharge : Command::RefreshBank;
      consider(ready(What, B), R, Precedence::Refresh, What, Which, None, None);
      Blocked |= uint64_t{1} << Which;
      continue;
    }
    const uint64_t All = (~uint64_t{0} >> (64 - Table.banksPerRank())) << First;
    const Command What = Open & All ? Command::PrechargeAll : Command::Refresh;
    if (!(Opened & All))
      consider(Common[placeOfRank(R, What)], R, Precedence::Refresh, What,
               First, None, None);
    Blocked |= All;
  }
}

void Controller::considerQueue() {
  Schedule.ask([this](const auto &S) { considerQueueBy(S); });
}

template <typename Scheduler>
inline void Controller::considerQueueBy(const Scheduler &S) {
  // What cannot begin before something else has is no business of ours, but of
  // a scheduler that may let others wait for it.
  constexpr bool IsOwn = std::is_same_v<Scheduler, FrFcfs>;
  const Queue &Q = Queues[IsDraining];
  const Command Column = activeColumn();
  uint64_t Best = Never, TicksOfBest = 0;
  uint32_t BankOfBest = None;
  const auto Weigh = [&](uint32_t Bank, Kind Which, Command What, bool Waits) {
    const Oldest &Candidate = Q.Banks[Bank].OldestOf[Which];
    const uint64_t Ticks =
        Waits ? DramCandidate::Waits
              : std::max({Banks[Bank].Next[size_t(What)],
                          Common[Banks[Bank].Common + size_t(What)],
                          BusReady[size_t(What)]}) -
                    Now;
    const uint64_t Rank =
        S.rank({.Ticks = Ticks,
                .Order = Candidate.Order,
                .Bank = Bank,
                .Row = IsOwn ? 0 : Entries[Candidate.Entry].Row,
                .Uses = Banks[Bank].Uses,
                .Next = What == Command::Activate    ? DramCandidate::Activate
                        : What == Command::Precharge ? DramCandidate::Precharge
                                                     : DramCandidate::Access,
                .IsWrite = IsDraining});
    BankOfBest = Rank < Best ? Bank : BankOfBest;
    TicksOfBest = Rank < Best ? Ticks : TicksOfBest;
    Best = std::min(Best, Rank);
  };
  const auto WeighAll = [&](uint64_t Left, Kind Which, Command What,
                            bool Waits = false) {
    for (; Left; Left &= Left - 1)
      Weigh(static_cast<uint32_t>(std::countr_zero(Left)), Which, What, Waits);
  };
  const uint64_t Hits = Q.BanksWith[Hit] & (CapsRows ? ~Capped : ~uint64_t{0});
  const uint64_t Misses = Q.BanksWith[Miss];
  WeighAll(Hits & ~Blocked, Hit, Column);
  if (!IsOwn)
    WeighAll(Hits & Blocked, Hit, Column, true);
  const uint64_t BestHit = Best;
  WeighAll(Misses & ~Blocked & Open & ~Opened, Miss, Command::Precharge);
  if (!Half)
    WeighAll(Misses & ~Blocked & ~Open, Miss, Command::Activate);
  if (!IsOwn) {
    WeighAll(Misses & Open & (Blocked | Opened), Miss, Command::Precharge,
             true);
    WeighAll(Misses & ~Open & (Half ? ~uint64_t{0} : Blocked), Miss,
             Command::Activate, true);
  }
  if (BankOfBest != None && TicksOfBest != DramCandidate::Waits) {
    const Kind Which = Best == BestHit ? Hit : Miss;
    const uint32_t Entry = Q.Banks[BankOfBest].OldestOf[Which].Entry;
    consider(Now + TicksOfBest, Entries[Entry].Order, Precedence::Queue,
             nextOf(Entries[Entry]), BankOfBest, Entry, None);
  }
  if (CapsRows && (Q.BanksWith[Hit] & Capped & ~Blocked))
    considerCapped(Q);
}

/// A row beyond its cap is used only for the oldest request of its bank group.
void Controller::considerCapped(const Queue &Q) {
  const Command Column = activeColumn();
  for (uint32_t G = 0; G != groups(); ++G) {
    const uint64_t Group = (~uint64_t{0} >> (64 - Table.BanksPerGroup))
                           << (G * Table.BanksPerGroup);
    const uint64_t Waiting = Q.BanksWith[Hit] | Q.BanksWith[Miss];
    uint64_t First = Never;
    uint32_t BankOfFirst = None; ///< if it is for a row beyond its cap
    for (uint64_t Left = Waiting & ~Blocked & Group; Left; Left &= Left - 1) {
      const auto Bank = static_cast<uint32_t>(std::countr_zero(Left));
      for (const Kind Which : {Hit, Miss}) {
        const Oldest &Candidate = Q.Banks[Bank].OldestOf[Which];
        if (Candidate.Entry == None || Candidate.Order >= First)
          continue;
        First = Candidate.Order;
        BankOfFirst = Which == Hit && (Capped >> Bank & 1) ? Bank : None;
      }
    }
    if (BankOfFirst != None)
      consider(ready(Column, Banks[BankOfFirst]), First, Precedence::Capped,
               Column, BankOfFirst, Q.Banks[BankOfFirst].OldestOf[Hit].Entry,
               None);
  }
}

void Controller::considerClosing() {
  const uint64_t Wanted =
      Blocked | Opened | Queues[0].BanksWith[Hit] | Queues[1].BanksWith[Hit];
  for (uint64_t Left = Open & ~Wanted; Left; Left &= Left - 1) {
    const auto Which = static_cast<uint32_t>(std::countr_zero(Left));
    const Bank &B = Banks[Which];
    const uint64_t Unused =
        Options.CloseRowAfter -
        std::min<uint64_t>(Options.CloseRowAfter,
                           LaterTicks[size_t(Command::Precharge)]);
    consider(std::max(ready(Command::Precharge, B), B.LastUse + Unused), Which,
             Precedence::Closing, Command::Precharge, Which, None, None);
  }
}

} // namespace vorion::isasim::dram
