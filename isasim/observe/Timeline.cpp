#include "observe/Timeline.h"

#include "core/Core.h"
#include "machine/Report.h"
#include "observe/GrowingFile.h"
#include "observe/Tool.h"
#include "raster/WorkLog.h"
#include "vorion/isasim/Machine.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

namespace {

/// Rows of the picture come in these groups.
enum Process : unsigned { Runs = 1, Cores = 2, Rasterizers = 3 };

/// Lane slots a clock (VORION.md, section 1: the rasterizer's 16 lanes).
constexpr uint64_t RasterLanes = 16;

std::string jsonName(const std::string &Text) {
  return jsonText(nlohmann::json(Text));
}

} // namespace

void Timeline::event(const std::string &Json) {
  if (End == 0)
    append(Out, "{{\"otherData\": {{\"format\": \"vorion-timeline 1\", "
                "\"unit\": \"1 us = 1 warp instruction of a core, or 1 "
                "clock of a rasterizer's lanes\"}},\n\"traceEvents\": [\n");
  else
    append(Out, ",\n");
  append(Out, "{}", Json);
  End = 1;
}

void Timeline::nameRow(const Row &R, const std::string &Name) {
  event(fmt::format("{{\"ph\": \"M\", \"name\": \"thread_name\", \"pid\": {}, "
                    "\"tid\": {}, \"args\": {{\"name\": {}}}}}",
                    R.Process, R.Thread, jsonName(Name)));
}

void Timeline::flush(Row &R) {
  if (R.Last.To > R.Last.From)
    event(fmt::format("{{\"ph\": \"X\", \"name\": {}, \"pid\": {}, \"tid\": "
                      "{}, \"ts\": {}, \"dur\": {}}}",
                      jsonName(R.Last.Name), R.Process, R.Thread, R.Last.From,
                      R.Last.To - R.Last.From));
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
      event(fmt::format("{{\"ph\": \"M\", \"name\": \"process_name\", \"pid\": "
                        "{}, \"args\": {{\"name\": \"{}\"}}}}",
                        static_cast<unsigned>(Id), Name));
    for (unsigned N = 0; N != Shape.cores() * Shape.WarpsPerCore; ++N) {
      Warps.push_back({Cores, N, {}, 0});
      nameRow(Warps.back(),
              fmt::format("core {} warp {}", N / Shape.WarpsPerCore,
                          N % Shape.WarpsPerCore));
    }
    for (unsigned N = 0; N != Shape.sockets(); ++N) {
      Units.push_back({Rasterizers, N, {}, 0});
      nameRow(Units.back(), fmt::format("rasterizer {}", N));
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
  event(fmt::format("{{\"ph\": \"X\", \"name\": \"tile\", \"pid\": {}, "
                    "\"tid\": {}, \"ts\": {}, \"dur\": {}, \"args\": "
                    "{{\"core\": {}, \"gaussians\": {}, \"clipped\": {}, "
                    "\"fragments\": {}, \"blends\": {}}}}}",
                    R.Process, R.Thread, From, R.Retired - From, W.Core,
                    W.Counts.Gaussians, W.Counts.Clipped, W.Counts.Fragments,
                    W.Counts.Blends));
}

void Timeline::runEnds(const RunResult &Result) {
  for (Row &W : Warps)
    flush(W);
  // The next run begins when everything of this one has ended.
  for (const Row &U : Units)
    Now = std::max(Now, U.Retired);
  event(fmt::format("{{\"ph\": \"X\", \"name\": {}, \"pid\": {}, \"tid\": 0, "
                    "\"ts\": {}, \"dur\": {}, \"args\": {{\"outcome\": \"{}\", "
                    "\"warp_instructions\": {}}}}}",
                    jsonName(RunName.empty() ? Program->name() : RunName),
                    static_cast<unsigned>(Process::Runs), RunBegan,
                    Now - RunBegan, describe(Result.End),
                    Result.Total.WarpInstructions));
  // Complete now; the next run writes over the end.
  std::fflush(Out);
  End = std::ftell(Out);
  append(Out, "\n]}}\n");
  std::fflush(Out);
  std::fseek(Out, End, SEEK_SET);
}

namespace {

class TimelineTool : public Tool {
public:
  explicit TimelineTool(GrowingFile FileIn)
      : File(std::move(FileIn)), Times(File.stream()) {}
  std::vector<Observer *> observers() override { return {&Times}; }
  Expected<Success> runEnded(const std::string &, const RunResult &) override {
    return File.complete();
  }

private:
  GrowingFile File;
  Timeline Times;
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &) {
  Expected<GrowingFile> File = GrowingFile::open(Text);
  if (!File)
    return File.error();
  return std::unique_ptr<Tool>(
      std::make_unique<TimelineTool>(std::move(*File)));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  return {{"--timeline", Text}};
}

} // namespace

const ToolKind tools::Timeline{.Make = make, .Outputs = outputs};

} // namespace vorion::isasim
