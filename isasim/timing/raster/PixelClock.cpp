#include "timing/raster/PixelClock.h"

#include "raster/RasterTables.h"
#include "timing/common/DatapathUnits.h"

#include <algorithm>

namespace vorion::isasim {

namespace {
constexpr uint32_t PixelBytes = sizeof(raster::Pixel);

size_t bytesOf(const raster::TailWork &W) {
  return sizeof(W) + W.Records.size() * sizeof(W.Records[0]) +
         W.Pixels.size() * sizeof(W.Pixels[0]);
}
} // namespace

PixelClock::PixelClock(const TimingConfig &Params, MemoryPort Port,
                       unsigned Cores, size_t MostHeldIn)
    : Timing(Params.Pixel), MostHeld(MostHeldIn), Expected(Cores),
      Fetch(Port, Timing.BufferEntries) {}

void PixelClock::expect(unsigned Core, raster::TailWork &&Executed) {
  Held += bytesOf(Executed);
  Expected[Core].push_back(std::move(Executed));
}

void PixelClock::watch(const TimeWatch *Observers, unsigned Own) {
  Watch = Observers;
  Ledger.listen(nullptr);
  if (Watch)
    Ledger.listen([this, Own](PixelCycle What, uint64_t From, uint64_t Until) {
      Watch->tell(
          [&](TimeObserver &O) { O.pixelSpent(Own, What, {From, Until}); });
    });
}

void PixelClock::begin(uint64_t Start) {
  MoreWork = true;
  if (Now == Stage::Idle)
    DoneAt = std::max(DoneAt, Start);
  Ledger.begin(Start);
  Spent = {};
}

void PixelClock::reset() {
  for (auto &E : Expected)
    E.clear();
  Held = 0;
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
  case Stage::Record:
    recorded(Memory);
    break;
  case Stage::Group:
    startGroup(Memory);
    break;
  case Stage::Fetch:
    fetch(Memory);
    break;
  case Stage::Store:
    storeGroup(Memory);
    break;
  case Stage::Done:
    if (Watch)
      Watch->tell(
          [this](TimeObserver &O) { O.tileRest(Work, {TakenAt, DoneAt}); });
    Now = Queue.empty() ? Stage::Idle : Stage::Take;
    At = Queue.empty() ? Turn::Never : DoneAt;
    return Serving;
  case Stage::Empty:
  case Stage::Idle:
    break;
  }
  return std::nullopt;
}

void PixelClock::answer(const Answer &A) {
  if (!Fetch.answer(A))
    return;
  switch (Now) {
  case Stage::Record:
    At = Fetch.readyAt(GaussianFetch::Others);
    break;
  case Stage::Group:
    nextGroup();
    break;
  case Stage::Fetch:
    fetched();
    break;
  case Stage::Empty:
    stored();
    break;
  case Stage::Idle:
  case Stage::Take:
  case Stage::Store:
  case Stage::Done:
    break;
  }
}

std::span<const raster::TailWork::OpenPixel>
PixelClock::pixelsOf(size_t Which) const {
  const std::span All(Work.Pixels);
  const size_t First = Which * Timing.Lanes;
  return All.subspan(First, std::min<size_t>(Timing.Lanes, All.size() - First));
}

/// Asks for the lines of a group's pixels.
void PixelClock::pixelLines(MemorySystem &Memory, unsigned Set, size_t Which,
                            CacheOp Op) {
  const raster::Job &J = Work.What;
  Fetch.beginSet(Set);
  const auto Lines = [&](uint32_t First, uint32_t Bytes) {
    uint32_t Last = 0;
    for (const auto &Pixel : pixelsOf(Which)) {
      const uint32_t Line =
          lineOf(First + Pixel.Y * (J.OutputPitch / PixelBytes * Bytes) +
                 Pixel.X * Bytes);
      if (Line == Last)
        continue;
      Last = Line;
      Fetch.line(Memory, Set, Line, Op);
    }
  };
  Lines(J.Output, PixelBytes);
  if (Op == CacheOp::Read && J.IsLimited)
    Lines(J.Limit, sizeof(uint32_t));
  if (Op == CacheOp::Read && J.StartsLate)
    Lines(J.From, sizeof(uint32_t));
}

void PixelClock::take(MemorySystem &Memory) {
  Serving = Queue.front();
  Queue.pop_front();
  Work = {};
  // A run that failed may have ended before the hand-over was executed.
  if (!Expected[Serving].empty()) {
    Work = std::move(Expected[Serving].front());
    Expected[Serving].pop_front();
    Held -= bytesOf(Work);
  }
  ++Spent.Tails;
  spend(PixelCycle::Idle, At - DoneAt);
  TakenAt = At;
  Fetch.begin(At);
  Group = 0;
  if (!Work.Record) {
    Now = Stage::Done;
    return;
  }
  Fetch.beginSet(GaussianFetch::Others);
  Fetch.read(Memory, GaussianFetch::Others, Work.Record, Work.What.tailBytes());
  Now = Stage::Record;
  At = Fetch.readyAt(GaussianFetch::Others);
}

void PixelClock::recorded(MemorySystem &Memory) {
  Fetch.waitUntil(At);
  waitFor(At, Fetch.arrivalOf(GaussianFetch::Others), PixelCycle::Load);
  if (groups() == 0) {
    Now = Stage::Done;
    return;
  }
  pixelLines(Memory, pixelSet(0), 0, CacheOp::Read);
  nextGroup();
}

void PixelClock::nextGroup() {
  Now = Stage::Group;
  At = std::max(DoneAt, Fetch.readyAt(pixelSet(Group)));
}

/// The next group's pixels are read while this one's are worked on.
void PixelClock::startGroup(MemorySystem &Memory) {
  waitFor(At, Fetch.arrivalOf(pixelSet(Group)), PixelCycle::Load);
  Fetch.waitUntil(At);
  if (Group + 1 != groups())
    pixelLines(Memory, pixelSet(Group + 1), Group + 1, CacheOp::Read);
  Fetch.beginList();
  Visits = 0;
  for (const auto &Pixel : pixelsOf(Group)) {
    Visits = std::max(Visits, Pixel.Visits);
    Spent.Visits += Pixel.Visits;
  }
  Visits = std::min(Visits, static_cast<uint32_t>(Work.Records.size()));
  Number = Evaluated = 0;
  // All Gaussians are still in the buffer, if they fit.
  if (Group != 0 && Work.Records.size() <= Fetch.entries()) {
    spend(PixelCycle::Evaluate, Visits);
    Number = Evaluated = Visits;
  }
  Now = Stage::Fetch;
  fetched();
}

void PixelClock::fetch(MemorySystem &Memory) {
  Fetch.waitUntil(At);
  const uint64_t EntryAt = Fetch.entryAt(Memory, Work.What.List + 4 * Number);
  if (EntryAt > Fetch.now()) {
    At = EntryAt;
    return;
  }
  // Nothing was left to evaluate while its entry was on its way.
  if (Evaluated == Number)
    waitFor(Fetch.now(), Fetch.arrivalOfEntry(), PixelCycle::Fetch);
  Fetch.readRecord(Memory, Number, Work.Records[Number],
                   sizeof(raster::Gaussian));
  ++Number;
  fetched();
}

/// Evaluates what is known to come, in order, and says when there is more to
/// do.
void PixelClock::fetched() {
  for (; Evaluated != Number; ++Evaluated) {
    const Arrival Record = Fetch.arrivalOfRecord(Evaluated);
    if (Record.At == Turn::Never)
      break;
    waitFor(Record.At, Record, PixelCycle::Fetch);
    spend(PixelCycle::Evaluate, 1);
    Fetch.hold(Evaluated, DoneAt);
  }
  if (Number != Visits) {
    At = Fetch.startOf(Number);
    return;
  }
  At = Turn::Never;
  if (Evaluated != Number)
    return;
  Now = Stage::Store;
  At = DoneAt;
}

/// Pixels are written when the lanes are empty.
void PixelClock::storeGroup(MemorySystem &Memory) {
  Fetch.waitUntil(DoneAt + laneDepth(Work.What.Units));
  pixelLines(Memory, GaussianFetch::Others, Group, CacheOp::Write);
  if (++Group != groups())
    return nextGroup();
  Now = Stage::Empty;
  stored();
}

/// Done if the last pixels have been taken.
void PixelClock::stored() {
  At = Turn::Never;
  const Arrival Taken = Fetch.arrivalOf(GaussianFetch::Others);
  if (Taken.At == Turn::Never)
    return;
  waitFor(Taken.At, Taken, PixelCycle::Store);
  Now = Stage::Done;
  At = DoneAt;
}

/// What cycles go to that nobody has spent yet.
PixelCycle PixelClock::rest() const {
  switch (Now) {
  case Stage::Record:
  case Stage::Group:
    return PixelCycle::Load;
  case Stage::Fetch:
    return PixelCycle::Fetch;
  case Stage::Store:
  case Stage::Empty:
  case Stage::Done:
    return PixelCycle::Store;
  case Stage::Idle:
  case Stage::Take:
    break;
  }
  return PixelCycle::Idle;
}

void PixelClock::end(uint64_t End) { Spent.Cycles = Ledger.end(End, rest()); }

} // namespace vorion::isasim
