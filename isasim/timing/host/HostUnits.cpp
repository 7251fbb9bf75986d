#include "timing/host/HostUnits.h"

#include "timing/common/Picoseconds.h"

#include <utility>

namespace vorion::isasim {

namespace {

constexpr uint64_t CommandBytes = 64;

uint64_t linesOf(const HostCopy &C) {
  if (C.Bytes == 0)
    return 0;
  const uint64_t Head = C.Address % TimingLineBytes;
  return (Head + C.Bytes + TimingLineBytes - 1) / TimingLineBytes;
}

/// Line \p Number of the copy, from \p Base on.
uint32_t lineAt(uint32_t Base, uint64_t Number) {
  return static_cast<uint32_t>(Base / TimingLineBytes * TimingLineBytes +
                               Number * TimingLineBytes);
}

/// What writes line \p Number: the first and the last may be written in part.
CacheOp writeOf(const HostCopy &C, uint64_t Number) {
  const uint64_t Begin = lineAt(C.Address, Number);
  const bool IsWhole =
      Begin >= C.Address && Begin + TimingLineBytes <= C.Address + C.Bytes;
  return IsWhole ? CacheOp::WriteWhole : CacheOp::Write;
}

} // namespace

HostUnits::HostUnits(const TimingConfig &Params)
    : Timing(Params.Host), ChipMhz(Params.ClockMhz),
      OneWay(quotientUp(uint64_t{Timing.OneWayNs} * ChipMhz, 1000)),
      DecodeCycles(quotientUp(uint64_t{Timing.DecodeNs} * ChipMhz, 1000)),
      LineCycles(
          quotientUp(quotientUp(TimingLineBytes, Timing.DmaBytes) * ChipMhz,
                     L2Link::l2Mhz(Params))),
      LinePs(quotientUp(TimingLineBytes * PsTimesMhz, Timing.LinkMbps)),
      Engines(Timing.DmaEngines) {
  for (Engine &E : Engines) {
    E.Places.resize(Timing.DmaRequests);
    freePlaces(E);
  }
}

/// Empties all places of \p E; the first is used first.
void HostUnits::freePlaces(Engine &E) {
  E.Free.clear();
  for (uint32_t N = Timing.DmaRequests; N != 0; --N)
    E.Free.push_back(N - 1);
}

void HostUnits::watch(const TimeWatch *Observers) {
  Ledger.listen(nullptr);
  if (Observers)
    Ledger.listen([=](CommandCycle Why, uint64_t From, uint64_t Until) {
      Observers->tell(
          [&](TimeObserver &O) { O.commandSpent(Why, {From, Until}); });
    });
  for (unsigned N = 0; N != Engines.size(); ++N) {
    Engines[N].Ledger.listen(nullptr);
    if (Observers)
      Engines[N].Ledger.listen(
          [=](DmaCycle Why, uint64_t From, uint64_t Until) {
            Observers->tell(
                [&](TimeObserver &O) { O.dmaSpent(N, Why, {From, Until}); });
          });
  }
}

void HostUnits::begin(uint64_t Now) {
  Present = std::max(Present, Now);
  Ledger.begin(Now);
  OfProcessor = {};
  LinkBytes = 0;
  for (Engine &E : Engines) {
    E.Ledger.begin(Now);
    E.Time = {};
  }
}

void HostUnits::end(uint64_t End) {
  OfProcessor.Cycles = Ledger.end(End, CommandCycle::Idle);
  for (Engine &E : Engines)
    E.Time.Cycles = E.Ledger.end(End, rest(E));
}

/// What it does as long as it has not got to the end of that: a copy that goes
/// over the host's link waits for this, which is slower than memory.
DmaCycle HostUnits::rest(const Engine &E) const {
  if (E.Command == 0)
    return DmaCycle::Idle;
  const HostCopy::Kind Kind = at(E.Command).Copy.What;
  return Kind == HostCopy::Kind::ToDevice || Kind == HostCopy::Kind::FromDevice
             ? DmaCycle::HostLink
             : DmaCycle::Memory;
}

std::vector<DmaTime> HostUnits::engines() const {
  std::vector<DmaTime> All;
  All.reserve(Engines.size());
  for (const Engine &E : Engines)
    All.push_back(E.Time);
  return All;
}

void HostUnits::reset(uint64_t Now) {
  while (!Events.empty())
    Events.pop();
  Undecided.clear();
  Waiting.clear();
  Ledger.clear();
  for (Engine &E : Engines) {
    E.Command = 0;
    E.IsBlocked = false;
    freePlaces(E);
    E.Ledger.clear();
  }
  // Answers of memory that are still to come are for nobody.
  ++Epoch;
  Decoded = Ends.size();
  while (!Open.empty()) {
    if (Open.front().IsOpen)
      Ends[First - 1] = Now;
    forgetFirst();
  }
}

/// The oldest command has ended.
void HostUnits::forgetFirst() {
  const uint64_t Before = First == 1 ? 0 : AllEnds[First - 2];
  AllEnds.push_back(std::max(Before, Ends[First - 1]));
  Open.pop_front();
  ++First;
}

/// When a line that is ready at \p Now is over the host's link.
uint64_t HostUnits::carry(Direction &D, uint64_t Now) {
  LinkBytes += TimingLineBytes;
  return cycleOf(D.carry(psOf(Now, ChipMhz), LinePs), ChipMhz);
}

uint64_t HostUnits::sendCopy(const HostCopy &Copy, CommandOrder Order) {
  return send({.Copy = Copy, .Order = std::move(Order)});
}

uint64_t HostUnits::sendLaunch(CommandOrder Order) {
  return send({.IsLaunch = true, .Copy = {}, .Order = std::move(Order)});
}

uint64_t HostUnits::send(Command C) {
  Open.push_back(std::move(C));
  Ends.push_back(Turn::Never);
  IsRead.push_back(!Open.back().IsLaunch &&
                   Open.back().Copy.What == HostCopy::Kind::FromDevice);
  goOn();
  return Ends.size();
}

std::optional<uint64_t> HostUnits::endOf(uint64_t Number) const {
  if (Number == 0)
    return 0;
  const uint64_t End = Ends[Number - 1];
  return End == Turn::Never ? std::nullopt : std::optional(End);
}

/// When the last of \p Numbers has ended, plus what \p Later says of each.
template <typename Function>
std::optional<uint64_t> HostUnits::lastEnd(const std::vector<uint64_t> &Numbers,
                                           Function Later) const {
  uint64_t Last = 0;
  for (const uint64_t N : Numbers) {
    const auto End = endOf(N);
    if (!End)
      return std::nullopt;
    Last = std::max(Last, *End + Later(N));
  }
  return Last;
}

/// The next command is fetched and decoded, if it is known when.
bool HostUnits::decode(uint64_t Number) {
  Command &C = at(Number);
  // A read ends with its data at the host, which learns of other ends later.
  const auto HostGoesOn = lastEnd(C.Order.HostAfter, [this](uint64_t N) {
    return N != 0 && !IsRead[N - 1] ? OneWay : 0;
  });
  if (!HostGoesOn)
    return false;
  // The queue has as many places; they are used in turn.
  uint64_t PlaceFree = 0;
  if (Number > Timing.QueueEntries) {
    const uint64_t Before = Number - Timing.QueueEntries;
    if (Before >= First)
      return false;
    PlaceFree = AllEnds[Before - 1];
  }
  SentAt = std::max(SentAt, *HostGoesOn);
  const uint64_t Asked = std::max(SentAt + OneWay, PlaceFree);
  const uint64_t Fetched = std::max(Asked + 2 * OneWay, DecodedUntil);
  const auto Spend = [this](CommandCycle Why, uint64_t Until) {
    if (Until > DecodedUntil)
      Ledger.spend(Why, Until);
    DecodedUntil = std::max(DecodedUntil, Until);
  };
  Spend(CommandCycle::Idle, Asked);
  Spend(CommandCycle::Fetch, Fetched);
  Spend(CommandCycle::Decode, Fetched + DecodeCycles);
  C.DecodedAt = Fetched + DecodeCycles;
  ++OfProcessor.Commands;
  LinkBytes += CommandBytes;
  Undecided.push_back(Number);
  return true;
}

/// Something is known that commands may have waited for.
void HostUnits::goOn() {
  while (Decoded != Ends.size() && decode(Decoded + 1))
    ++Decoded;
  std::erase_if(Undecided, [this](uint64_t Number) {
    Command &C = at(Number);
    const auto Behind = lastEnd(C.Order.After, [](uint64_t) { return 0; });
    if (!Behind)
      return false;
    C.ReadyAt = std::max(*C.DecodedAt, *Behind);
    if (!C.IsLaunch)
      push(*C.ReadyAt, What::Ready, Number);
    return true;
  });
}

void HostUnits::ended(uint64_t Number, uint64_t At) {
  if (Ends[Number - 1] != Turn::Never)
    return; // reset() has been there
  Ends[Number - 1] = At;
  at(Number).IsOpen = false;
  while (!Open.empty() && !Open.front().IsOpen)
    forgetFirst();
  goOn();
}

void HostUnits::push(uint64_t At, What Kind, uint64_t Number, uint32_t Place) {
  Events.push(std::max(At, Present), Serial++, Kind, Number, Place);
}

void HostUnits::step(MemorySystem &Memory) {
  const Event E = Events.front();
  Events.pop();
  Present = std::max(Present, E.At);
  switch (E.Kind) {
  case What::Ready:
    Waiting.push_back(E.Number);
    startCopies(E.At);
    break;
  case What::Begin:
    beginLine(Engines[E.Number], E.At, Memory);
    break;
  case What::AtDevice:
    Engines[E.Number].Places[E.Place].FirstDone = E.At;
    write(Engines[E.Number], E.Place, E.At, Memory);
    break;
  case What::Answered:
    answered(Engines[E.Number], E.Place, E.At, Memory);
    break;
  case What::Gone:
    lineDone(Engines[E.Number], E.Place, E.At);
    break;
  }
}

/// Copies that are ready take the engines that have nothing to do.
void HostUnits::startCopies(uint64_t Now) {
  for (Engine &E : Engines) {
    if (E.Command != 0)
      continue;
    while (!Waiting.empty() && linesOf(at(Waiting.front()).Copy) == 0) {
      const uint64_t Empty = Waiting.front();
      Waiting.pop_front();
      ended(Empty, Now);
    }
    if (Waiting.empty())
      return;
    E.Command = Waiting.front();
    Waiting.pop_front();
    E.Next = 0;
    E.Lines = linesOf(at(E.Command).Copy);
    spend(E, DmaCycle::Idle, Now);
    ++E.Time.Copies;
    push(Now, What::Begin, numberOf(E));
  }
}

void HostUnits::beginLine(Engine &E, uint64_t Now, MemorySystem &Memory) {
  if (E.Free.empty()) {
    E.IsBlocked = true;
    return;
  }
  const uint32_t Place = E.Free.back();
  E.Free.pop_back();
  E.Places[Place] = {Now, E.Next, false};
  const HostCopy &C = at(E.Command).Copy;
  switch (C.What) {
  case HostCopy::Kind::ToDevice:
    push(carry(ToDevice, Now + OneWay) + OneWay, What::AtDevice, numberOf(E),
         Place);
    break;
  case HostCopy::Kind::FromDevice:
    access(E, Place, Now, CacheOp::Read, lineAt(C.Address, E.Next), Memory);
    break;
  case HostCopy::Kind::OnDevice:
    access(E, Place, Now, CacheOp::Read, lineAt(C.From, E.Next), Memory);
    break;
  case HostCopy::Kind::Fill:
    write(E, Place, Now, Memory);
    break;
  }
  ++E.Next;
  ++E.Time.Lines;
  spend(E, DmaCycle::Move, Now + LineCycles);
  if (E.Next != E.Lines)
    push(Now + LineCycles, What::Begin, numberOf(E));
}

/// A line in \p Place asks memory for something.
void HostUnits::access(Engine &E, uint32_t Place, uint64_t Now, CacheOp Op,
                       uint32_t Address, MemorySystem &Memory) {
  const auto Engine = static_cast<uint32_t>(numberOf(E));
  const auto Known =
      Memory.accessBehindLink({.Now = Now,
                               .Address = Address,
                               .Op = Op,
                               .From = {MemorySystem::IsBehindLink | Engine,
                                        (Epoch << PlaceBits) | Place}});
  if (Known)
    push(*Known, What::Answered, Engine, Place);
}

void HostUnits::answer(const Answer &A) {
  if (A.To.Tag >> PlaceBits == (Epoch << PlaceBits) >> PlaceBits)
    push(A.At, What::Answered, A.To.Unit & ~MemorySystem::IsBehindLink,
         A.To.Tag & ((1U << PlaceBits) - 1));
}

void HostUnits::write(Engine &E, uint32_t Place, uint64_t Now,
                      MemorySystem &Memory) {
  Line &L = E.Places[Place];
  const HostCopy &C = at(E.Command).Copy;
  L.IsWrite = true;
  access(E, Place, Now, writeOf(C, L.Number), lineAt(C.Address, L.Number),
         Memory);
}

void HostUnits::answered(Engine &E, uint32_t Place, uint64_t Now,
                         MemorySystem &Memory) {
  Line &L = E.Places[Place];
  if (L.IsWrite) {
    lineDone(E, Place, Now);
    return;
  }
  L.FirstDone = Now;
  if (at(E.Command).Copy.What == HostCopy::Kind::FromDevice)
    push(carry(FromDevice, Now), What::Gone, numberOf(E), Place);
  else
    write(E, Place, Now, Memory);
}

/// The line's place is free. An engine that had waited for that did so for the
/// line's two halves, one after the other.
void HostUnits::lineDone(Engine &E, uint32_t Place, uint64_t Now) {
  const Line &L = E.Places[Place];
  E.Free.push_back(Place);
  const bool IsLast = E.Next == E.Lines && E.Free.size() == Timing.DmaRequests;
  if (!E.IsBlocked && !IsLast)
    return;
  const HostCopy::Kind Kind = at(E.Command).Copy.What;
  spend(E,
        Kind == HostCopy::Kind::ToDevice ? DmaCycle::HostLink
                                         : DmaCycle::Memory,
        std::min(L.FirstDone, Now));
  spend(E,
        Kind == HostCopy::Kind::FromDevice ? DmaCycle::HostLink
                                           : DmaCycle::Memory,
        Now);
  if (E.IsBlocked) {
    E.IsBlocked = false;
    push(Now, What::Begin, numberOf(E));
    return;
  }
  const uint64_t Number = std::exchange(E.Command, 0);
  E.Time.Bytes += at(Number).Copy.Bytes;
  // What the host gets is there when the last line is.
  ended(Number, Now + (Kind == HostCopy::Kind::FromDevice ? OneWay : 0));
  startCopies(Now);
}

void HostUnits::spend(Engine &E, DmaCycle Reason, uint64_t Until) {
  if (Until <= E.SpentUntil)
    return;
  E.Ledger.spend(Reason, Until);
  E.SpentUntil = Until;
}

} // namespace vorion::isasim
