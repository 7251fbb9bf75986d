#include "tools/RegionRun.h"

#include "vorion/support/ClockText.h"

#include <fmt/format.h>

namespace vorion::isasim {

namespace {

/// What the launches took, as a table.
class TimeTable {
public:
  void add(const std::string &Name, const RunResult &R) {
    ++Launches;
    Text += fmt::format("{:>6} {:<32} {:>14}\n", Launches, Name,
                        R.Time ? fmt::format("{}", R.Time->Cycles) : "-");
    if (!R.Time)
      return;
    Last = R.Time;
    Cycles += R.Time->Cycles;
  }
  std::string text() const {
    std::string All =
        fmt::format("{:>6} {:<32} {:>14}\n", "launch", "kernel", "cycles") +
        Text;
    if (Last)
      All += fmt::format(
          "{:>6} {:<32} {:>14}\nmachine      {}\n", "", "all", Cycles,
          clockedMachine(Last->Machine, Last->ClockMhz, ClockVersion));
    return All;
  }

private:
  std::string Text;
  unsigned Launches = 0;
  uint64_t Cycles = 0;
  std::optional<TimeReport> Last;
};

/// Gives \p M what \p L begins with.
bool prepare(const SavedRegion &R, const SavedLaunch &L, Machine &M,
             MemoryChanges &Memory) {
  if (L.IsFresh) {
    M.load(R.Images[L.Image]);
    if (!M.setImageData(L.ImageData))
      return false;
  }
  std::span<const std::byte> Rest = L.PageBytes;
  for (const MemoryChanges::Page P : L.Pages) {
    const size_t Bytes = Memory.bytesOf(P);
    if (Bytes == 0 || Bytes > Rest.size())
      return false;
    Memory.put(P, Rest.first(Bytes));
    Rest = Rest.subspan(Bytes);
  }
  return Rest.empty();
}

} // namespace

Expected<RunResult>
runRegion(const SavedRegion &R, Machine &M, Session &Watch, bool ChoosesClock,
          const std::string &Where,
          const std::function<void(std::string_view)> &Print) {
  const auto Bad = [&](const SavedLaunch &L, const char *What) {
    return Error{Where, fmt::format("launch {}, {}: {}",
                                    &L - R.Launches.data() + 1, L.Name, What)};
  };
  Expected<MemoryChanges> Memory = MemoryChanges::of(M);
  if (!Memory)
    return Memory.error();
  if (!M.setRasterState(R.RasterState))
    return Error{Where, "rasterizer state of another machine, expected that of "
                        "its configuration"};
  TimeTable Times;
  RunResult Result;
  for (const SavedLaunch &L : R.Launches) {
    if (!prepare(R, L, M, *Memory))
      return Bad(L, "memory outside the machine's");
    if (ChoosesClock)
      M.setClocking(L.IsCounted ? Clocking::On : Clocking::WarmUp);
    Watch.runBegins(L.Name, L.Block);
    Result = M.run(L.Block);
    Times.add(L.Name, Result);
    if (const Expected<Success> Ok = Watch.runEnded(Result); !Ok)
      return Ok.error();
    if (Result.End != Outcome::Done)
      break;
    if (Memory->takeDigest() != L.Changes)
      return Bad(L, "the replay left different memory contents, expected a "
                    "deterministic program and the same simulator");
  }
  Print(Times.text());
  return Result;
}

} // namespace vorion::isasim
