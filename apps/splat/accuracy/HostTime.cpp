#include "accuracy/HostTime.h"

#include "accuracy/Rtl.h"
#include "device/Stage.h"
#include "page/VerdictPage.h"
#include "study/Process.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>
#include <map>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// How often what takes less than this is run, and what takes longer, once.
constexpr unsigned QuickRuns = 3;
constexpr double Quick = 2; // seconds

/// What a stage did: by this its cycles grow from one view to another.
struct StageWork {
  double Amount = 0, Cycles = 0;
};

/// One `splat render`.
struct Frame {
  double Seconds = 0, Cycles = 0, Instructions = 0, Cores = 1;
  std::map<std::string, StageWork> Stages;
};

/// A sum of a counter over the kernels of a stage.
double sumOf(const Json &Stage, const char *Counter) {
  double Sum = 0;
  for (const Json &Kernel : Stage["kernels"])
    if (Kernel.contains("counters"))
      Sum += Kernel["counters"][Counter].get<double>();
  return Sum;
}

Frame frameOf(const Json &Report, double Seconds) {
  Frame F;
  F.Seconds = Seconds;
  F.Cores = Report["device"]["compute_units"].get<double>();
  for (const Json &Stage : Report["stages"]) {
    const double Fragments = sumOf(Stage, "raster_fragments");
    const double Instructions = sumOf(Stage, "warp_instructions");
    F.Instructions += Instructions;
    F.Stages[Stage["name"].get<std::string>()].Amount +=
        Fragments > 0 ? Fragments : Instructions;
  }
  if (Report.contains("time")) {
    F.Cycles = Report["time"]["sum"]["cycles"].get<double>();
    for (const Json &Stage : Report["time"]["stages"])
      if (Stage["of_the_frame"].get<bool>() && Stage.contains("time"))
        F.Stages[Stage["name"].get<std::string>()].Cycles +=
            Stage["time"]["cycles"].get<double>();
  }
  return F;
}

Expected<Frame> draw(const SweepPlan &P, const Camera &View, bool Clocked) {
  const std::string Base = P.Folder + "/work/host";
  const std::string Picture = Base + ".pfm";
  std::vector<std::string> Words = renderWords(P, View.Name, Picture);
  if (Clocked)
    Words.emplace_back("--time");
  DeviceOptions Machine = P.Machine;
  if (!Clocked)
    Machine.set("VORION_TIME", "off");
  const auto Done = runForReport(std::move(Words), Machine, Base);
  if (!Done)
    return Done.error();
  std::filesystem::remove(Picture);
  return frameOf(Done->Report, Done->ProcessorSeconds);
}

/// The cycles that \p Of would take if each of its stages took as many for its
/// work as it did for that of \p Sample, which was clocked.
double scaledCycles(const Frame &Sample, const Frame &Of) {
  double Cycles = 0;
  for (const auto &[Name, Work] : Sample.Stages) {
    const auto Own = Of.Stages.find(Name);
    if (Own != Of.Stages.end() && Work.Amount > 0)
      Cycles += Work.Cycles * Own->second.Amount / Work.Amount;
  }
  return Cycles;
}

double percentOff(double Is, double Right) { return 100 * (Is / Right - 1); }

/// The three that need nothing but this program.
Expected<std::vector<HostTime>>
measureSimulations(const SweepPlan &P, const std::vector<Camera> &Views,
                   const std::function<void(std::string_view)> &Log) {
  HostTime Functional{
      "functional", {}, false, {}, "one cycle per warp instruction of a core"};
  HostTime Sampled{"sampled", {}, false, {}, ""};
  HostTime Clocked{
      "clocked", {}, false, 0, "the reference for the cycles of the others"};
  std::vector<Frame> Plain, Timed;
  unsigned Runs = QuickRuns;
  for (unsigned Run = 0; Run < Runs; ++Run) {
    Plain.clear();
    Timed.clear();
    double PlainSeconds = 0, TimedSeconds = 0;
    for (const Camera &View : Views)
      for (const bool WithClock : {false, true}) {
        Log(fmt::format("simulation time: {}, {} simulation, run {}", View.Name,
                        WithClock ? "clocked" : "functional", Run + 1));
        auto F = draw(P, View, WithClock);
        if (!F)
          return F.error();
        (WithClock ? TimedSeconds : PlainSeconds) += F->Seconds;
        (WithClock ? Timed : Plain).push_back(std::move(*F));
      }
    Functional.Seconds.push_back(PlainSeconds);
    Clocked.Seconds.push_back(TimedSeconds);
    Sampled.Seconds.push_back(PlainSeconds - Plain.front().Seconds +
                              Timed.front().Seconds);
    if (TimedSeconds > Quick)
      Runs = 1;
  }
  double Right = 0, OfInstructions = 0, OfSample = 0;
  for (std::size_t V = 0; V < Views.size(); ++V) {
    Right += Timed[V].Cycles;
    OfInstructions += Plain[V].Instructions / Plain[V].Cores;
    OfSample += scaledCycles(Timed.front(), Timed[V]);
  }
  Functional.ErrorPercent = percentOff(OfInstructions, Right);
  if (Views.size() > 1) {
    Sampled.ErrorPercent = percentOff(OfSample, Right);
    Sampled.Note = fmt::format("clock only for {}; other views extrapolated",
                               Views.front().Name);
  } else {
    Sampled.Seconds.clear();
    Sampled.Note = "not measured, expected at least two views";
  }
  return std::vector{Functional, Sampled, Clocked};
}

HostTime ofRtl(const SweepPlan &P, const Camera &View,
               const std::function<void(std::string_view)> &Log) {
  HostTime T{"rasterizer's RTL", {}, false, {}, ""};
  const auto Found = runRtl(P, View, Log);
  if (!Found) {
    T.Note = Found.error().What;
    return T;
  }
  T.Extrapolated = true;
  T.Seconds.push_back(Found->Seconds * Found->AllTiles / Found->Tiles);
  T.ErrorPercent = Found->ErrorPercent;
  T.Note = fmt::format(
      "{} of {} tiles of {}, selected at random, {:.3g} s; largest error of "
      "the clock for a tile {:.2f} %{}",
      Found->Tiles, Found->AllTiles, View.Name, Found->Seconds,
      Found->WorstPercent,
      Found->WrongPixels == 0
          ? ""
          : fmt::format("; {} pixels DIFFER", Found->WrongPixels));
  return T;
}

AnswerTable tableOf(const std::vector<HostTime> &All) {
  AnswerTable T{"", "", {"simulation", "host s", "cycle error", ""}, {}};
  for (const HostTime &One : All) {
    std::string Seconds = "-";
    if (!One.Seconds.empty()) {
      const auto [Least, Most] = std::ranges::minmax(One.Seconds);
      Seconds = One.Seconds.size() == 1
                    ? fmt::format("{:.3g}", Least)
                    : fmt::format("{:.3g} to {:.3g}", Least, Most);
    }
    T.Rows.push_back(
        {One.Simulation, Seconds + (One.Extrapolated ? " (extrapolated)" : ""),
         One.ErrorPercent ? fmt::format("{:+.2f} %", *One.ErrorPercent) : "-",
         One.Note});
  }
  return T;
}

} // namespace

Expected<std::vector<HostTime>>
measureHostTime(const SweepPlan &P, const std::vector<Camera> &Views,
                const std::function<void(std::string_view)> &Log) {
  auto All = measureSimulations(P, Views, Log);
  if (All)
    All->push_back(ofRtl(P, Views.front(), Log));
  return All;
}

std::string hostTimeText(const std::vector<HostTime> &All,
                         const std::vector<Camera> &Views) {
  std::vector<std::string> Names;
  Names.reserve(Views.size());
  for (const Camera &View : Views)
    Names.push_back(View.Name);
  return fmt::format("simulation times for {}, in processor seconds of the "
                     "whole program:\n{}",
                     fmt::join(Names, ","), toString(tableOf(All)));
}

Json hostTimeJson(const std::vector<HostTime> &All) {
  Json Rows = Json::array();
  for (const HostTime &One : All)
    Rows.push_back({{"simulation", One.Simulation},
                    {"seconds", One.Seconds},
                    {"extrapolated", One.Extrapolated},
                    {"cycles_error_percent",
                     One.ErrorPercent ? Json(*One.ErrorPercent) : Json()},
                    {"note", One.Note}});
  return Rows;
}

} // namespace vorion::splat
