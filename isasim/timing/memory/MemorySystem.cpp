#include "timing/memory/MemorySystem.h"

#include <algorithm>

namespace vorion::isasim {

template <typename Params> static CacheShape shape(const Params &P) {
  return {P.Kib * 1024, P.Ways,      P.Banks,
          P.Mshrs,      P.HitCycles, P.IntersectHint != 0};
}

MemorySystem::MemorySystem(const TimingConfig &Params, unsigned Clusters)
    : KeepsWriters(Params.Core.DcacheKib != 0), HasLink(L2Link::exists(Params)),
      Link(Params), Fixed(Params.L2.FixedCycles),
      Ram(Params.Dram, L2Link::l2Mhz(Params)), Llc(shape(Params.Llc), Ram),
      L2HitCycles(Params.L2.HitCycles) {
  for (unsigned C = 0; C != Clusters; ++C)
    Slices.emplace_back(shape(Params.L2), Llc, C);
}

uint32_t MemorySystem::writeCycles(const TimingConfig &Params) {
  return L2Link::exists(Params) || Params.L2.FixedCycles
             ? 0
             : Params.L2.HitCycles / 2;
}

std::optional<uint64_t> MemorySystem::access(unsigned Cluster,
                                             const CacheRequest &R) {
  if (KeepsWriters && R.Op != CacheOp::Read)
    Writers.written(R.Address,
                    R.Op == CacheOp::Atomic ? Ticket::Nobody : R.From.Unit);
  if (!HasLink)
    return accessL2(Cluster, R);
  const L2Link::Sent Sent = Link.send(R.Now, R.Op);
  CacheRequest There = R;
  There.Now = Sent.There;
  if (R.Op == CacheOp::Write || R.Op == CacheOp::WriteWhole) {
    // The link has it: nobody waits for the L2.
    There.From = {};
    accessL2(Cluster, There);
    return Sent.Gone;
  }
  if (const auto At = accessL2(Cluster, There))
    Link.give({R.From, *At});
  return std::nullopt;
}

std::optional<uint64_t> MemorySystem::accessL2(unsigned Cluster,
                                               const CacheRequest &R) {
  if (Fixed.exists())
    return Fixed.access(R);
  if (R.Op != CacheOp::Atomic || Slices.size() == 1)
    return Slices[Cluster].L2.access(R);
  // Past the slice, whose crossbar it still crosses both ways.
  CacheRequest Below = R;
  Below.Now += L2HitCycles / 2;
  Below.Back += L2HitCycles - L2HitCycles / 2;
  return Llc.access(Below);
}

void MemorySystem::advance(uint64_t Until, std::vector<Answer> &Answers) {
  if (!HasLink)
    return advanceL2(Until, Answers);
  const uint64_t Limit = Link.lastInL2(Until);
  for (;;) {
    const uint64_t Next = Link.nextAnswer();
    if (Next <= Limit && Next <= Ram.nextEvent()) {
      // Nothing that comes later is ready before it.
      Answers.push_back(Link.takeAnswer());
      return;
    }
    if (Ram.nextEvent() > Limit)
      return;
    FromL2.clear();
    advanceL2(std::min(Limit, Next), FromL2);
    for (const Answer &A : FromL2)
      Link.give(A);
  }
}

void MemorySystem::advanceL2(uint64_t Until, std::vector<Answer> &Answers) {
  Fills.clear();
  Ram.advance(Until, Fills);
  for (const DramChannels::Fill &F : Fills) {
    FromLlc.clear();
    Llc.fill(F.Miss, F.At, FromLlc);
    for (const Answer &A : FromLlc)
      if (A.To.Unit & IsSlice)
        Slices[A.To.Unit & ~IsSlice].L2.fill(A.To.Tag, A.At, Answers);
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
    End = std::max(End, S.L2.flush(Begin));
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
  const MemoryWatch *const Told = Watch ? &*Watch : nullptr;
  Ram.watch(Told);
  Llc.watch(Told, {.IsLlc = true});
  for (unsigned N = 0; N != Slices.size(); ++N)
    Slices[N].L2.watch(Told, {.Slice = N});
}

void MemorySystem::begin() {
  Writers.clear();
  Link.clearCounters();
  Ram.clearCounters();
  Llc.clearCounters();
  for (Slice &S : Slices)
    S.L2.clearCounters();
}

void MemorySystem::report(TimeReport &R) const {
  for (const Slice &S : Slices)
    R.L2.push_back(S.L2.time());
  R.Llc = Llc.time();
  R.LinkBytes = {Link.bytesToL2(), Link.bytesFromL2()};
  R.Dram = Ram.time();
  R.DramBurstBytes = Ram.burstBytes();
  R.DramTableFile = Ram.tableFile();
  R.DramTableHash = Ram.tableHash();
}

} // namespace vorion::isasim
