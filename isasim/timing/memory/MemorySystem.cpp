#include "timing/memory/MemorySystem.h"

#include <algorithm>

namespace vorion::isasim {

template <typename Params>
static CacheShape shape(const Params &P, const char *Name) {
  return {.Bytes = P.Kib * 1024,
          .Ways = P.Ways,
          .Banks = P.Banks,
          .Mshrs = P.Mshrs,
          .HitCycles = P.HitCycles,
          .Hint = P.IntersectHint != 0,
          .Name = Name};
}

MemorySystem::MemorySystem(const TimingConfig &Params, unsigned Clusters,
                           uint32_t Ports)
    : KeepsWriters(Params.Core.DcacheKib != 0), HasLink(L2Link::exists(Params)),
      Link(Params), Fixed(Params.L2.FixedCycles),
      FixedBelow(Params.Llc.ConstantCycles),
      Ram(Params.Dram, L2Link::l2Mhz(Params)),
      Llc(shape(Params.Llc, "llc"), Ram), HasCrossbars(Params.L2.Crossbar != 0),
      LastPort(Ports - 1), L2HitCycles(Params.L2.HitCycles) {
  CacheShape OfL2 = shape(Params.L2, "l2");
  OfL2.WriteThrough = Params.L2.WriteThrough != 0;
  for (unsigned C = 0; C != Clusters; ++C) {
    Slice &S = Slices.emplace_back(*this, C);
    OfL2.Number = C;
    if (HasCrossbars)
      S.L2 = std::make_unique<CrossbarCache>(
          OfL2, Params.L2.Queue, Ports, std::max(1U, Params.Core.DcacheBanks),
          S.Door);
    else
      S.L2 = std::make_unique<Cache>(OfL2, S.Door);
  }
}

uint32_t MemorySystem::writeCycles(const TimingConfig &Params) {
  return L2Link::exists(Params) || Params.L2.FixedCycles || Params.L2.Crossbar
             ? 0
             : Params.L2.HitCycles / 2;
}

std::optional<Arrival> MemorySystem::access(const MemoryPort &Port,
                                            CacheRequest &R) {
  R.Port = Port.Port;
  if (KeepsWriters && R.Op != CacheOp::Read)
    Writers.written(R.Address,
                    R.Op == CacheOp::Atomic ? Ticket::Nobody : R.From.Unit);
  if (!HasLink) {
    const auto At = accessL2(Port.Cluster, R);
    return At ? std::optional(Arrival{*At}) : std::nullopt;
  }
  const L2Link::Sent Sent = Link.send(R.Now, R.Op);
  R.Now = Sent.There;
  if (R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole) {
    // The link has it: nobody waits for the L2.
    R.From = R.Dequeued = {};
    accessL2(Port.Cluster, R);
    return Arrival{.At = Sent.Gone, .RequestUntil = Sent.Gone};
  }
  R.From.RequestUntil = Link.toChip(Sent.There);
  if (const auto At = accessL2(Port.Cluster, R))
    Link.give(R.From, *At);
  return std::nullopt;
}

std::optional<uint64_t> MemorySystem::accessBehindLink(const CacheRequest &R) {
  if (KeepsWriters && R.Op != CacheOp::Read)
    Writers.written(R.Address, Ticket::Nobody);
  CacheRequest There = R;
  There.Port = LastPort;
  if (HasLink)
    There.Now = Link.firstInL2(R.Now);
  std::optional<uint64_t> Known;
  if (Fixed.exists())
    Known = Fixed.access(There);
  else
    Known = Slices.size() == 1 ? Slices[0].L2->access(There) : accessLlc(There);
  return Known && HasLink ? Link.toChip(*Known) : Known;
}

void MemorySystem::give(const Answer &A, std::vector<Answer> &Answers) {
  if (A.To.Unit != Ticket::Nobody && A.To.Unit & IsBehindLink)
    Answers.push_back({A.To, Link.toChip(A.At)});
  else
    Link.give(A.To, A.At);
}

std::optional<uint64_t> MemorySystem::accessL2(unsigned Cluster,
                                               const CacheRequest &R) {
  if (Fixed.exists())
    return Fixed.access(R);
  if (R.Op != CacheOp::Atomic || Slices.size() == 1)
    return Slices[Cluster].L2->access(R);
  // Past the slice, whose crossbar it still crosses both ways.
  CacheRequest Below = R;
  Below.Now += L2HitCycles / 2;
  Below.Back += L2HitCycles - L2HitCycles / 2;
  return accessLlc(Below);
}

std::optional<uint64_t> MemorySystem::accessLlc(const CacheRequest &R) {
  return FixedBelow.exists() ? FixedBelow.access(R) : Llc.access(R);
}

SharedCache &MemorySystem::firstSlice() const {
  return *std::ranges::min_element(Slices, {}, [](const Slice &S) {
            return S.L2->nextEvent();
          })->L2;
}

void MemorySystem::advance(uint64_t Until, std::vector<Answer> &Answers) {
  if (!HasLink)
    return advanceL2(Until, Answers);
  const uint64_t Limit = Link.lastInL2(Until);
  const size_t Before = Answers.size();
  for (;;) {
    const uint64_t Next = Link.nextAnswer();
    if (Next <= Limit && Next <= nextEventInL2()) {
      // Nothing that comes later is ready before it.
      Link.takeAnswer(Answers);
      return;
    }
    if (nextEventInL2() > Limit)
      return;
    FromL2.clear();
    advanceL2(std::min(Limit, Next), FromL2);
    for (const Answer &A : FromL2)
      give(A, Answers);
    if (Answers.size() != Before)
      return;
  }
}

void MemorySystem::advanceL2(uint64_t Until, std::vector<Answer> &Answers) {
  if (!HasCrossbars)
    return advanceRam(Until, Answers);
  while (Answers.empty() && nextEventInL2() <= Until) {
    SharedCache &First = firstSlice();
    if (Ram.nextEvent() <= First.nextEvent())
      advanceRam(std::min(Until, First.nextEvent()), Answers);
    else
      First.step(Answers);
  }
}

void MemorySystem::advanceRam(uint64_t Until, std::vector<Answer> &Answers) {
  Fills.clear();
  Ram.advance(Until, Fills);
  for (const DramChannels::Fill &F : Fills) {
    FromLlc.clear();
    Llc.fill(F.Miss, F.At, FromLlc);
    for (const Answer &A : FromLlc)
      if (A.To.Unit & IsSlice)
        Slices[A.To.Unit & ~IsSlice].L2->fill(A.To.Tag, A.At, Answers);
      else
        Answers.push_back(A);
  }
}

uint64_t MemorySystem::endRun(uint64_t Now) {
  if (Slices.size() == 1)
    return Now;
  const uint64_t Begin = HasLink ? Link.firstInL2(Now) : Now;
  uint64_t End = Begin;
  for (Slice &S : Slices)
    End = std::max(End, S.L2->flush(Begin));
  return HasLink ? Link.toChip(End) : End;
}

void MemorySystem::idleUntil(uint64_t End) {
  if (!Fixed.exists())
    Ram.idleUntil(HasLink ? Link.lastInL2(End) : End);
}

void MemorySystem::watch(const TimeWatch *Observers) {
  Watch.reset();
  if (Observers)
    Watch.emplace(*Observers, HasLink ? &Link : nullptr);
  Link.watch(Observers);
  const MemoryWatch *const Told = Watch ? &*Watch : nullptr;
  Ram.watch(Told);
  Llc.watch(Told, {.IsLlc = true});
  for (unsigned N = 0; N != Slices.size(); ++N)
    Slices[N].L2->watch(Told, {.Slice = N});
}

void MemorySystem::begin(uint64_t Now) {
  Writers.clear();
  Link.begin(Now);
  Ram.clearCounters();
  Llc.clearCounters();
  for (Slice &S : Slices)
    S.L2->clearCounters();
}

void MemorySystem::report(TimeReport &R, uint64_t End) const {
  for (const Slice &S : Slices)
    R.L2.push_back(S.L2->time());
  R.Llc = Llc.time();
  R.Link = Link.time(End);
  R.Dram = Ram.time();
  R.DramBurstBytes = Ram.burstBytes();
  R.DramTableFile = Ram.tableFile();
  R.DramTableHash = Ram.tableHash();
}

} // namespace vorion::isasim
