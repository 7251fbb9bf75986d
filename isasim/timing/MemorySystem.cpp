#include "timing/MemorySystem.h"

#include <algorithm>

namespace vorion::isasim {

template <typename Params> static CacheShape shape(const Params &P) {
  return {P.Kib * 1024, P.Ways,      P.Banks,
          P.Mshrs,      P.HitCycles, P.IntersectHint != 0};
}

MemorySystem::MemorySystem(const TimingConfig &Params, unsigned Clusters)
    : Ram(Params), Llc(shape(Params.Llc), Ram), ToLlc(Llc),
      L2HitCycles(Params.L2.HitCycles) {
  for (unsigned C = 0; C != Clusters; ++C)
    Slices.push_back(std::make_unique<Cache>(shape(Params.L2), ToLlc));
}

uint64_t MemorySystem::access(unsigned Cluster, const CacheRequest &R) {
  if (R.Op != CacheOp::Atomic || Slices.size() == 1)
    return Slices[Cluster]->access(R);
  // Past the slice, whose crossbar it still crosses both ways.
  CacheRequest Below = R;
  Below.Now += L2HitCycles / 2;
  return Llc.access(Below) + L2HitCycles - L2HitCycles / 2;
}

uint64_t MemorySystem::endRun(uint64_t Now) {
  if (Slices.size() == 1)
    return Now;
  uint64_t End = Now;
  for (const auto &S : Slices)
    End = std::max(End, S->flush(Now));
  return End;
}

void MemorySystem::clearCounters() {
  Ram.Ram.clearCounters();
  Llc.clearCounters();
  for (const auto &S : Slices)
    S->clearCounters();
}

void MemorySystem::report(TimeReport &R) const {
  for (const auto &S : Slices)
    R.L2.push_back(S->time());
  R.Llc = Llc.time();
  R.Dram = Ram.Ram.time();
}

} // namespace vorion::isasim
