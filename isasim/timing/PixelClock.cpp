#include "timing/PixelClock.h"

#include "raster/RasterTables.h"
#include "timing/DatapathUnits.h"

#include <algorithm>

namespace vorion::isasim {

namespace {
constexpr uint32_t PixelBytes = sizeof(raster::Pixel);
} // namespace

PixelClock::PixelClock(const TimingConfig &Params, unsigned ClusterIn,
                       unsigned Cores)
    : P(Params.Pixel), Cluster(ClusterIn), Expected(Cores),
      Fetch(Cluster, P.BufferEntries) {}

void PixelClock::begin(uint64_t Start) {
  if (Now == Stage::Idle)
    DoneAt = std::max(DoneAt, Start);
  Ledger.begin(Start);
  Spent = {};
}

void PixelClock::reset() {
  for (auto &E : Expected)
    E.clear();
  Queue.clear();
  Now = Stage::Idle;
  At = Turn::Never;
  Ledger.clear();
}

void PixelClock::accept(unsigned Core, uint64_t Then) {
  Queue.push_back(Core);
  if (Now != Stage::Idle)
    return;
  Now = Stage::Take;
  At = std::max(Then, DoneAt);
}

std::optional<unsigned> PixelClock::step(MemorySystem &Memory) {
  Ledger.settle(At);
  switch (Now) {
  case Stage::Take:
    take(Memory);
    break;
  case Stage::Group:
    startGroup(Memory);
    break;
  case Stage::Fetch:
    fetch(Memory);
    break;
  case Stage::Done:
    Now = Queue.empty() ? Stage::Idle : Stage::Take;
    At = Queue.empty() ? Turn::Never : DoneAt;
    return Serving;
  case Stage::Idle:
    break;
  }
  return std::nullopt;
}

/// The lines of a group's pixels; returns when the last has come or been taken.
uint64_t PixelClock::pixelLines(MemorySystem &Memory, size_t Which,
                                bool IsWrite) {
  uint64_t Ready = Fetch.now();
  uint32_t Last = 0;
  const size_t End =
      std::min(Work.Pixels.size(), (Which + 1) * size_t{P.Lanes});
  for (size_t N = Which * P.Lanes; N < End; ++N) {
    const auto &Pixel = Work.Pixels[N];
    const uint32_t Line =
        lineOf(Work.What.Output + Pixel.Y * Work.What.OutputPitch +
               Pixel.X * PixelBytes);
    if (Line == Last)
      continue;
    Last = Line;
    Ready =
        std::max(Ready, Fetch.line(Memory, Line,
                                   IsWrite ? CacheOp::Write : CacheOp::Read));
  }
  return Ready;
}

void PixelClock::take(MemorySystem &Memory) {
  Serving = Queue.front();
  Queue.pop_front();
  Work = {};
  // A run that failed may have ended before the hand-over was executed.
  if (!Expected[Serving].empty()) {
    Work = std::move(Expected[Serving].front());
    Expected[Serving].pop_front();
  }
  ++Spent.Tails;
  spend(PixelCycle::Idle, At - DoneAt);
  Fetch.begin(At);
  Group = 0;
  if (!Work.Record) {
    Now = Stage::Done;
    return;
  }
  Fetch.waitUntil(Fetch.read(Memory, Work.Record, sizeof(raster::Tail)));
  PixelsReady = pixelLines(Memory, 0, false);
  spend(PixelCycle::Load, std::max(PixelsReady, DoneAt) - DoneAt);
  Now = groups() == 0 ? Stage::Done : Stage::Group;
  At = DoneAt;
}

/// The next group's pixels are read while this one's are worked on.
void PixelClock::startGroup(MemorySystem &Memory) {
  if (PixelsReady > DoneAt)
    spend(PixelCycle::Load, PixelsReady - DoneAt);
  Fetch.waitUntil(At);
  if (Group + 1 != groups())
    PixelsReady = pixelLines(Memory, Group + 1, false);
  Fetch.beginList();
  Visits = 0;
  const size_t End =
      std::min(Work.Pixels.size(), (Group + 1) * size_t{P.Lanes});
  for (size_t N = Group * P.Lanes; N < End; ++N) {
    Visits = std::max(Visits, Work.Pixels[N].Visits);
    Spent.Visits += Work.Pixels[N].Visits;
  }
  Visits = std::min(Visits, static_cast<uint32_t>(Work.Records.size()));
  Number = 0;
  // All Gaussians are still in the buffer, if they fit.
  if (Group != 0 && Work.Records.size() <= Fetch.entries()) {
    spend(PixelCycle::Evaluate, Visits);
    return finishGroup(Memory);
  }
  if (Visits == 0)
    return finishGroup(Memory);
  Now = Stage::Fetch;
  At = Fetch.startOf(0);
}

void PixelClock::fetch(MemorySystem &Memory) {
  Fetch.waitUntil(At);
  if (!Fetch.hasEntry(Memory, Work.What.List + 4 * Number)) {
    At = Fetch.now();
    return;
  }
  const uint64_t Ready = Fetch.readRecord(Memory, Work.Records[Number]);
  if (Ready > DoneAt)
    spend(PixelCycle::Fetch, Ready - DoneAt);
  spend(PixelCycle::Evaluate, 1);
  Fetch.hold(Number, DoneAt);
  if (++Number == Visits)
    return finishGroup(Memory);
  At = Fetch.startOf(Number);
}

void PixelClock::finishGroup(MemorySystem &Memory) {
  Fetch.waitUntil(DoneAt + laneDepth(Work.What.Units));
  const uint64_t Taken = pixelLines(Memory, Group, true);
  if (++Group == groups()) {
    // The lanes empty, and the last pixels are written.
    spend(PixelCycle::Store, std::max(Taken, DoneAt) - DoneAt);
    Now = Stage::Done;
  } else {
    Now = Stage::Group;
  }
  At = DoneAt;
}

void PixelClock::end(uint64_t End) {
  const PixelCycle Rest = Now == Stage::Group   ? PixelCycle::Load
                          : Now == Stage::Fetch ? PixelCycle::Fetch
                          : Now == Stage::Done  ? PixelCycle::Store
                                                : PixelCycle::Idle;
  Spent.Cycles = Ledger.end(End, Rest);
}

} // namespace vorion::isasim
