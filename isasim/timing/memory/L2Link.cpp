#include "timing/memory/L2Link.h"

#include <algorithm>

namespace vorion::isasim {

/// Cycles in \p Ps.
static uint64_t wholeCycles(uint64_t Ps, uint64_t Mhz) {
  return Ps * Mhz / PsTimesMhz;
}

L2Link::L2Link(const TimingConfig &Params)
    : ChipMhz(Params.ClockMhz), Mhz(l2Mhz(Params)), ByChipMhz(ChipMhz),
      ByMhz(Mhz), To(uint64_t{Params.Link.ToL2Ns} * 1000, Params.Link.ToL2Mbps,
                     Params.Link.HeaderBytes),
      From(uint64_t{Params.Link.FromL2Ns} * 1000, Params.Link.FromL2Mbps,
           Params.Link.HeaderBytes) {}

L2Link::Direction::Direction(uint64_t LatencyIn, uint64_t Mbps,
                             uint32_t HeaderBytes)
    : Latency(LatencyIn) {
  for (const bool HasData : {false, true}) {
    const uint32_t Count = HeaderBytes + (HasData ? TimingLineBytes : 0);
    Messages[HasData] = {Count,
                         Mbps ? quotientUp(Count * PsTimesMhz, Mbps) : 0};
  }
}

bool L2Link::exists(const TimingConfig &Params) {
  const LinkTiming &P = Params.Link;
  return l2Mhz(Params) != Params.ClockMhz || P.ToL2Ns || P.FromL2Ns ||
         P.ToL2Mbps || P.FromL2Mbps;
}

inline uint64_t L2Link::Direction::leave(uint64_t Now, bool HasData) {
  const Message &M = Messages[HasData];
  if (Now > FreeAt)
    BusySince = FreeAt = Now;
  Bytes += M.Bytes;
  Busy += M.Ps;
  FreeAt += M.Ps;
  return FreeAt;
}

uint64_t L2Link::Direction::busyUntil(uint64_t Now) const {
  return Busy - (FreeAt - std::clamp(Now, BusySince, FreeAt));
}

/// Direction::leave() of a direction, which is reported to observers.
inline uint64_t L2Link::leave(bool IsToL2, uint64_t Now, bool HasData) {
  Direction &Way = IsToL2 ? To : From;
  if (!Watch)
    return Way.leave(Now, HasData);
  const uint64_t Begin = cycleOf(std::max(Now, Way.FreeAt), ChipMhz);
  const uint64_t BusyBefore = wholeCycles(Way.Busy, ChipMhz);
  const uint64_t Left = Way.leave(Now, HasData);
  // Short messages have parts of a cycle, which add up.
  const uint64_t Cycles = wholeCycles(Way.Busy, ChipMhz) - BusyBefore;
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
  const uint64_t Left = leave(true, psOfChip(Now), Op != CacheOp::Read);
  return {cycleOf(Left, ChipMhz), cycleOf(Left + To.Latency, Mhz)};
}

void L2Link::takeAnswer(std::vector<Answer> &Taken) {
  const Waiting &First = Answers.front();
  const uint64_t Left = leave(false, psOfL2(First.At), true);
  Taken.emplace_back(First.To, cycleOf(Left + From.Latency, ChipMhz),
                     toChip(First.At));
  Answers.pop();
}

} // namespace vorion::isasim
