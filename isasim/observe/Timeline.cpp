/// What every warp and rasterizer did and when, for Perfetto
/// (docs/profiling.md, "Timeline").
#include "core/Core.h"
#include "machine/Report.h"
#include "observe/CycleTimeline.h"
#include "observe/Tool.h"
#include "observe/TraceEvents.h"
#include "raster/WorkLog.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Observer.h"
#include "vorion/support/GrowingFile.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <vector>

namespace vorion::isasim {

/// Time here is counted, not modelled: a microsecond stands for one warp
/// instruction of a core. Between two points where all cores are parked, all
/// cores start at once, and the longest decides where the next part starts. A
/// rasterizer's span is as long as its lanes need for the fragments at one lane
/// slot each, from the point where its command was executed or the end of its
/// span before.
class Timeline : public Observer {
public:
  /// \p File as for TraceEvents. It is complete after every run.
  explicit Timeline(std::FILE *File)
      : Out(File, "1 warp instruction of a core, or 1 clock of a rasterizer's "
                  "lanes") {}

  void runNamed(const std::string &Name) override { RunName = Name; }
  void runBegins(const RunStart &R) override;
  void syncPoint(std::span<const std::unique_ptr<Core>> Cores) override;
  void rasterCommand(const raster::CommandWork &W) override;
  void runEnds(const RunResult &R) override;

private:
  struct Slice {
    std::string Name;
    uint64_t From = 0, To = 0;
  };
  /// One row of the picture.
  struct Row {
    unsigned Process = 0, Thread = 0;
    Slice Last; ///< not yet written: it may grow
    uint64_t Retired = 0;
  };

  void add(Row &R, const std::string &Name, uint64_t From, uint64_t To);
  void flush(Row &R);

  TraceEvents Out;
  std::string RunName;
  std::shared_ptr<const Image> Program;
  std::vector<Row> Warps, Units;
  unsigned CoresPerUnit = 1;
  uint64_t Now = 0, RunBegan = 0;
  unsigned Runs = 0;
};

namespace {

/// Rows of the picture come in these groups.
enum Process : unsigned { Runs = 1, Cores = 2, Rasterizers = 3 };

/// Lane slots a clock (VORION.md, section 1: the rasterizer's 16 lanes).
constexpr uint64_t RasterLanes = 16;

} // namespace

void Timeline::flush(Row &R) {
  if (R.Last.To > R.Last.From)
    Out.slice(R.Process, R.Thread, R.Last.Name, R.Last.From, R.Last.To);
  R.Last = {};
}

void Timeline::add(Row &R, const std::string &Name, uint64_t From,
                   uint64_t To) {
  if (From == To)
    return;
  if (R.Last.Name == Name && R.Last.To == From) {
    R.Last.To = To;
    return;
  }
  flush(R);
  R.Last = {Name, From, To};
}

void Timeline::runBegins(const RunStart &R) {
  Program = R.Program;
  RunBegan = Now;
  const Config &Shape = R.Shape;
  CoresPerUnit = Shape.CoresPerSocket;
  if (Runs++ == 0) {
    for (const auto &[Id, Name] : {std::pair{Process::Runs, "runs"},
                                   {Cores, "cores"},
                                   {Rasterizers, "rasterizers"}})
      Out.nameProcess(Id, Name);
    Out.nameThread(Process::Runs, 0, "runs");
    for (unsigned N = 0; N != Shape.cores() * Shape.WarpsPerCore; ++N) {
      Warps.push_back({Cores, N, {}, 0});
      Out.nameThread(Cores, N,
                     fmt::format("core {} warp {}", N / Shape.WarpsPerCore,
                                 N % Shape.WarpsPerCore));
    }
    for (unsigned N = 0; N != Shape.sockets(); ++N) {
      Units.push_back({Rasterizers, N, {}, 0});
      Out.nameThread(Rasterizers, N, fmt::format("rasterizer {}", N));
    }
  }
  for (Row &W : Warps)
    W.Retired = 0;
}

void Timeline::syncPoint(std::span<const std::unique_ptr<Core>> All) {
  uint64_t Longest = 0;
  size_t N = 0;
  // Warps of a core take turns: each begins where the one before it stopped.
  for (const auto &C : All) {
    uint64_t At = Now;
    for (const WarpState &S : std::as_const(*C).warps()) {
      Row &R = Warps[N++];
      const uint64_t Count = S.Count.WarpInstructions - R.Retired;
      R.Retired = S.Count.WarpInstructions;
      add(R, "running", At, At + Count);
      At += Count;
    }
    Longest = std::max(Longest, At - Now);
  }
  N = 0;
  for (const auto &C : All)
    for (const WarpState &S : std::as_const(*C).warps()) {
      Row &R = Warps[N++];
      if (S.Why != Stop::Ready && S.Why != Stop::Ended)
        add(R, waitsFor(S), std::max(R.Last.To, Now), Now + Longest);
    }
  Now += Longest;
}

void Timeline::rasterCommand(const raster::CommandWork &W) {
  Row &R = Units[W.Core / CoresPerUnit];
  const uint64_t From = std::max(Now, R.Retired); // where its last span ended
  R.Retired =
      From + std::max<uint64_t>(1, (W.Counts.Fragments + RasterLanes - 1) /
                                       RasterLanes);
  Out.slice(R.Process, R.Thread, "tile", From, R.Retired,
            fmt::format("{{\"core\": {}, \"gaussians\": {}, \"clipped\": {}, "
                        "\"fragments\": {}, \"blends\": {}}}",
                        W.Core, W.Counts.Gaussians, W.Counts.Clipped,
                        W.Counts.Fragments, W.Counts.Blends));
}

void Timeline::runEnds(const RunResult &Result) {
  for (Row &W : Warps)
    flush(W);
  // The next run begins when everything of this one has ended.
  for (const Row &U : Units)
    Now = std::max(Now, U.Retired);
  Out.slice(Process::Runs, 0, RunName.empty() ? Program->name() : RunName,
            RunBegan, Now,
            fmt::format("{{\"outcome\": \"{}\", \"warp_instructions\": {}}}",
                        describe(Result.End), Result.Total.WarpInstructions));
  Out.complete();
}

namespace {

/// In cycles where the machine has a clock, else in instructions.
class TimelineTool : public Tool {
public:
  TimelineTool(GrowingFile FileIn, const ToolOutput &To)
      : File(std::move(FileIn)), Times(File.stream()), Energy(To.Energy) {}
  std::vector<Observer *> observers() override {
    return InCycles ? std::vector<Observer *>{}
                    : std::vector<Observer *>{&Times};
  }
  std::vector<TimeObserver *> timeObservers() override {
    return InCycles ? std::vector<TimeObserver *>{&*InCycles}
                    : std::vector<TimeObserver *>{};
  }
  Expected<Success> attach(Machine &M) override {
    if (M.config().Timing.Enabled)
      InCycles.emplace(File.stream(), M.config(), Energy);
    return Success{};
  }
  Expected<Success> runEnded(const std::string &Name,
                             const RunResult &R) override {
    if (InCycles)
      InCycles->runEnded(Name, R.Time ? &*R.Time : nullptr);
    return File.complete();
  }

private:
  GrowingFile File;
  Timeline Times;
  std::optional<CycleTimeline> InCycles;
  std::shared_ptr<const EnergyModel> Energy;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  Expected<GrowingFile> File = GrowingFile::open(Text);
  if (!File)
    return File.error();
  return std::unique_ptr<Tool>(
      std::make_unique<TimelineTool>(std::move(*File), To));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  return {{"--timeline", Text}};
}

} // namespace

const ToolKind tools::Timeline{.Make = make, .Outputs = outputs};

} // namespace vorion::isasim
