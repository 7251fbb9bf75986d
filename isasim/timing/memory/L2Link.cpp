#include "timing/memory/L2Link.h"

#include "timing/common/Picoseconds.h"

#include <algorithm>

namespace vorion::isasim {

/// Cycles in \p Ps.
static uint64_t wholeCycles(uint64_t Ps, uint64_t Mhz) {
  return Ps * Mhz / PsTimesMhz;
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
  const uint64_t Ps = Mbps ? quotientUp(Count * PsTimesMhz, Mbps) : 0;
  if (Now > FreeAt)
    BusySince = FreeAt = Now;
  Bytes += Count;
  Busy += Ps;
  FreeAt += Ps;
  return FreeAt;
}

uint64_t L2Link::Direction::busyUntil(uint64_t Now) const {
  return Busy - (FreeAt - std::clamp(Now, BusySince, FreeAt));
}

/// Direction::leave() of a direction, which is reported to observers.
uint64_t L2Link::leave(bool IsToL2, uint64_t Now, uint32_t Count) {
  Direction &Way = IsToL2 ? To : From;
  const uint64_t Begin = cycleOf(std::max(Now, Way.FreeAt), ChipMhz);
  const uint64_t BusyBefore = wholeCycles(Way.Busy, ChipMhz);
  const uint64_t Left = Way.leave(Now, Count);
  // Short messages have parts of a cycle, which add up.
  const uint64_t Cycles = wholeCycles(Way.Busy, ChipMhz) - BusyBefore;
  if (Watch)
    Watch->tell(
        [&](TimeObserver &O) { O.linkBusy(IsToL2, {Begin, Begin + Cycles}); });
  return Left;
}

void L2Link::begin(uint64_t Now) {
  for (Direction *Way : {&To, &From}) {
    Way->Bytes = 0;
    Way->BusyThen = wholeCycles(Way->busyUntil(psOf(Now, ChipMhz)), ChipMhz);
  }
}

LinkTime L2Link::time(uint64_t End) const {
  const auto Busy = [&](const Direction &Way) {
    return wholeCycles(Way.busyUntil(psOf(End, ChipMhz)), ChipMhz) -
           Way.BusyThen;
  };
  return {.BytesToL2 = To.Bytes,
          .BytesFromL2 = From.Bytes,
          .BusyToL2 = Busy(To),
          .BusyFromL2 = Busy(From)};
}

L2Link::Sent L2Link::send(uint64_t Now, CacheOp Op) {
  const uint32_t Data = Op == CacheOp::Read ? 0 : TimingLineBytes;
  const uint64_t Left = leave(true, psOf(Now, ChipMhz), HeaderBytes + Data);
  return {cycleOf(Left, ChipMhz), cycleOf(Left + To.Latency, Mhz)};
}

void L2Link::give(const Answer &A) { Answers.push({A, Given++}); }

Answer L2Link::takeAnswer() {
  Answer A = Answers.front().What;
  Answers.pop();
  const uint64_t Left =
      leave(false, psOf(A.At, Mhz), HeaderBytes + TimingLineBytes);
  A.AnswerFrom = toChip(A.At);
  A.At = cycleOf(Left + From.Latency, ChipMhz);
  return A;
}

} // namespace vorion::isasim
