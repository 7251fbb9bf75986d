#include "timing/memory/L2Link.h"

#include <algorithm>

namespace vorion::isasim {

/// A cycle has so many ps times MHz.
static constexpr uint64_t PsTimesMhz = 1000000;

static uint64_t quotientUp(uint64_t A, uint64_t B) { return (A + B - 1) / B; }

/// When \p Cycle begins. Rounded down, so that cycleOf() gives it back.
static uint64_t psOf(uint64_t Cycle, uint64_t Mhz) {
  return Cycle * PsTimesMhz / Mhz;
}
/// The first cycle that does not begin before \p Ps.
static uint64_t cycleOf(uint64_t Ps, uint64_t Mhz) {
  return quotientUp(Ps * Mhz, PsTimesMhz);
}

L2Link::L2Link(const TimingConfig &Params)
    : ChipMhz(Params.ClockMhz), Mhz(l2Mhz(Params)),
      HeaderBytes(Params.Link.HeaderBytes),
      To{uint64_t{Params.Link.ToL2Ns} * 1000, Params.Link.ToL2Mbps},
      From{uint64_t{Params.Link.FromL2Ns} * 1000, Params.Link.FromL2Mbps} {}

bool L2Link::exists(const TimingConfig &Params) {
  const LinkTiming &P = Params.Link;
  return l2Mhz(Params) != Params.ClockMhz || P.ToL2Ns || P.FromL2Ns ||
         P.ToL2Mbps || P.FromL2Mbps;
}

uint64_t L2Link::toChip(uint64_t L2Cycle) const {
  return L2Cycle == Turn::Never ? L2Cycle : quotientUp(L2Cycle * ChipMhz, Mhz);
}

uint64_t L2Link::lastInL2(uint64_t Cycle) const {
  return Cycle == Turn::Never ? Cycle : Cycle * Mhz / ChipMhz;
}

uint64_t L2Link::firstInL2(uint64_t Cycle) const {
  return quotientUp(Cycle * Mhz, ChipMhz);
}

uint64_t L2Link::Direction::leave(uint64_t Now, uint32_t Count) {
  Bytes += Count;
  FreeAt = std::max(Now, FreeAt);
  if (Mbps)
    FreeAt += quotientUp(Count * PsTimesMhz, Mbps);
  return FreeAt;
}

L2Link::Sent L2Link::send(uint64_t Now, CacheOp Op) {
  const uint32_t Data = Op == CacheOp::Read ? 0 : TimingLineBytes;
  const uint64_t Left = To.leave(psOf(Now, ChipMhz), HeaderBytes + Data);
  return {cycleOf(Left, ChipMhz), cycleOf(Left + To.Latency, Mhz)};
}

void L2Link::give(const Answer &A) { Answers.push({A, Given++}); }

Answer L2Link::takeAnswer() {
  Answer A = Answers.front().What;
  Answers.pop();
  const uint64_t Left =
      From.leave(psOf(A.At, Mhz), HeaderBytes + TimingLineBytes);
  A.At = cycleOf(Left + From.Latency, ChipMhz);
  return A;
}

} // namespace vorion::isasim
