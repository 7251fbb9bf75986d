#include "timing/MemorySystem.h"

#include <algorithm>

namespace vorion::isasim {

template <typename Params> static CacheShape shape(const Params &P) {
  return {P.Kib * 1024, P.Ways,      P.Banks,
          P.Mshrs,      P.HitCycles, P.IntersectHint != 0};
}

MemorySystem::MemorySystem(const TimingConfig &Params, unsigned Clusters)
    : Ram(Params), Llc(shape(Params.Llc), Ram),
      L2HitCycles(Params.L2.HitCycles) {
  for (unsigned C = 0; C != Clusters; ++C)
    Slices.emplace_back(shape(Params.L2), Llc, C);
}

std::optional<uint64_t> MemorySystem::access(unsigned Cluster,
                                             const CacheRequest &R) {
  if (R.Op != CacheOp::Atomic || Slices.size() == 1)
    return Slices[Cluster].L2.access(R);
  // Past the slice, whose crossbar it still crosses both ways.
  CacheRequest Below = R;
  Below.Now += L2HitCycles / 2;
  Below.Back += L2HitCycles - L2HitCycles / 2;
  return Llc.access(Below);
}

void MemorySystem::advance(uint64_t Until, std::vector<Answer> &Answers) {
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
  uint64_t End = Now;
  for (Slice &S : Slices)
    End = std::max(End, S.L2.flush(Now));
  return End;
}

void MemorySystem::clearCounters() {
  Ram.clearCounters();
  Llc.clearCounters();
  for (Slice &S : Slices)
    S.L2.clearCounters();
}

void MemorySystem::report(TimeReport &R) const {
  for (const Slice &S : Slices)
    R.L2.push_back(S.L2.time());
  R.Llc = Llc.time();
  R.Dram = Ram.time();
  R.DramBurstBytes = Ram.burstBytes();
}

} // namespace vorion::isasim
