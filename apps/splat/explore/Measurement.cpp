#include "explore/Measurement.h"

#include "device/ClockedMachine.h"
#include "io/Mean.h"
#include "render/Bottleneck.h"
#include "study/Process.h"
#include "vorion/support/JsonShape.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <iterator>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// Of what runForReport() says, the program's own words.
std::string reasonIn(const std::string &What) {
  constexpr std::string_view Before = "splat: error: ";
  const std::size_t At = What.find(Before);
  return At == What.npos ? What : What.substr(At + Before.size());
}

/// What a run is of, and on what.
Json headOf(const Part &Of, const Task &What, const TriedMachine &M) {
  Json Head{{"machine", M.Name},
            {"settings", M.Settings},
            {"arguments", M.Arguments}};
  if (!Of.Name.empty())
    Head["part"] = Of.Name;
  if (Of.Does == Work::Frames)
    Head["view"] = What.View;
  else
    Head["iterations"] = What.Iterations;
  Head["width"] = What.Width;
  Head["height"] = What.Height;
  return Head;
}

/// The runs of the stages of that name.
struct StageRuns {
  std::string Name;
  StageTimes Runs;
};

/// A frame's stages, or those of the mean of iterations, which has one whenever
/// any of them has; each of \p Times is a time report by stage.
Json stagesOf(const std::vector<const Json *> &Times) {
  std::vector<StageRuns> Stages;
  for (const Json *Time : Times)
    for (const Json &Stage : (*Time)["stages"])
      if (Stage["of_the_frame"].get<bool>() && Stage.contains("time")) {
        const auto Name = Stage["name"].get<std::string>();
        auto At = std::ranges::find(Stages, Name, &StageRuns::Name);
        if (At == Stages.end())
          At = Stages.insert(At, {Name, {}});
        At->Runs.push_back(&Stage["time"]);
      }
  Json All = Json::array();
  for (const auto &[Name, Runs] : Stages) {
    uint64_t Cycles = 0;
    for (const Json *Run : Runs)
      Cycles += (*Run)["cycles"].get<uint64_t>();
    const Bottleneck Most = bottleneckOf(Runs);
    const Roof Under = roofOf(Runs, Most);
    All.push_back({{"name", Name},
                   {"cycles", Cycles / Times.size()},
                   {"unit", Most.Unit},
                   {"reason", Most.Reason},
                   {"share", Most.Share},
                   {"work_share", Under.Work},
                   {"memory_share", Under.Memory}});
  }
  return All;
}

Json frameOf(const Json &Report) {
  const Json &Time = Report["time"], &Energy = Report["energy"];
  return {{ClockedMachineKey, clockedMachine(Time["sum"])},
          {"picture", Report["result_fnv1a64"]},
          {timeKey(Work::Frames), Time["frame_ms"]},
          {"cycles", Time["sum"]["cycles"]},
          {"chip_joules", Energy["chip_joules"]},
          {"joules", Energy["joules"]},
          {"chip_um2", Energy["area"]["chip_um2"]},
          {"stages", stagesOf({&Time})}};
}

/// The mean of what \p Each gives of the iterations.
template <typename Function>
double meanOfTimed(const Json &Timed, Function Each) {
  std::vector<double> Values;
  Values.reserve(Timed.size());
  for (const Json &One : Timed)
    Values.push_back(Each(One).template get<double>());
  return meanOf(Values);
}

/// Iterations have the same technology: their intervals move together.
Json meanInterval(const Json &Timed, const char *Key) {
  Json Mean;
  for (const char *Bound : {"value", "low", "high"})
    Mean[Bound] = meanOfTimed(Timed, [&](const Json &One) -> const Json & {
      return One["energy"][Key][Bound];
    });
  return Mean;
}

Json iterationOf(const Json &Report) {
  const Json &Timed = Report["timed"];
  std::vector<const Json *> Times;
  for (const Json &One : Timed)
    Times.push_back(&One["time"]);
  return {{ClockedMachineKey, clockedMachine(Timed.front()["time"]["sum"])},
          {timeKey(Work::Iterations),
           meanOfTimed(Timed,
                       [](const Json &One) -> const Json & {
                         return One["time"]["frame_ms"];
                       })},
          {"cycles", meanOfTimed(Timed,
                                 [](const Json &One) -> const Json & {
                                   return One["time"]["sum"]["cycles"];
                                 })},
          {"chip_joules", meanInterval(Timed, "chip_joules")},
          {"joules", meanInterval(Timed, "joules")},
          {"chip_um2", Timed.front()["energy"]["area"]["chip_um2"]},
          {"stages", stagesOf(Times)}};
}

} // namespace

DeviceOptions changed(DeviceOptions Base, const std::string &Settings) {
  const std::string Before = Base.text("VORION_SET");
  Base.set("VORION_SET",
           Before + (Before.empty() || Settings.empty() ? "" : ",") + Settings,
           Base.giver("VORION_SET"));
  return Base;
}

Expected<Json> measureTask(const RunSetup &Setup, const Part &Of,
                           const Task &What, const TriedMachine &M,
                           const std::string &Files) {
  const bool Draws = Of.Does == Work::Frames;
  std::vector<std::string> Words = What.Words;
  const std::vector<std::string> Frame{"-o", Files + ".png"},
      Iterations{"-o",        Files + ".ply", "--checkpoint",
                 "/dev/null", "--time-every", "1"};
  for (const auto &More : {Draws ? Frame : Iterations, M.Arguments})
    std::ranges::copy(More, std::back_inserter(Words));
  Words.emplace_back("--energy");
  if (!Setup.Technology.empty())
    Words.insert(Words.end(), {"--technology", Setup.Technology});
  if (Setup.Volts)
    Words.insert(Words.end(), {"--voltage", fmt::format("{}", *Setup.Volts)});
  const auto Done =
      runForReport(std::move(Words), changed(Setup.Base, M.Settings), Files);
  if (!Done) {
    // By a setting, or by an option: what the base has is right.
    if (Done.error().Code != ExitCode::Usage || M.Name == "base")
      return Done.error();
    std::filesystem::remove(Files + ".log");
    Json Refused = headOf(Of, What, M);
    Refused["refused"] = reasonIn(Done.error().What);
    return Refused;
  }
  for (const char *Ending : {".png", ".ply", ".cameras.json"})
    std::filesystem::remove(Files + Ending);
  Json Result = headOf(Of, What, M);
  Result.update(Draws ? frameOf(Done->Report) : iterationOf(Done->Report));
  return Result;
}

bool isMeasurement(const Json &J) {
  const JsonShape Number = JsonShape::number(), Text = JsonShape::text();
  const bool Draws = J.contains("view");
  JsonShape Head = JsonShape::object(
      {{"machine", Text},
       {"settings", Text},
       {Draws ? "view" : "iterations", Draws ? Text : Number}});
  if (!Head.check(J, ""))
    return false;
  if (J.contains("refused"))
    return J["refused"].is_string();
  const JsonShape Interval =
      JsonShape::object({{"value", Number}, {"low", Number}, {"high", Number}});
  const JsonShape Stage = JsonShape::object({{"name", Text},
                                             {"cycles", Number},
                                             {"unit", Text},
                                             {"reason", Text},
                                             {"share", Number},
                                             {"work_share", Number},
                                             {"memory_share", Number}});
  const JsonShape Shape = JsonShape::object(
      {{ClockedMachineKey, Text},
       {"picture", Text, Draws},
       {timeKey(Draws ? Work::Frames : Work::Iterations), Number},
       {"cycles", Number},
       {"chip_joules", Interval},
       {"joules", Interval},
       {"chip_um2", Interval},
       {"stages", JsonShape::list(Stage)}});
  return bool(Shape.check(J, ""));
}

const char *timeKey(Work W) {
  return W == Work::Frames ? "frame_ms" : "iteration_ms";
}

std::string described(const Json &Measured) {
  if (Measured.contains("refused"))
    return "impossible: " + Measured["refused"].get<std::string>();
  const bool Draws = Measured.contains("view");
  return fmt::format(
      "{}: {:.3f} ms{}, chip {:.3g} mJ, {:.2f} mm2; {}",
      Measured["machine"].get<std::string>(),
      Measured[timeKey(Draws ? Work::Frames : Work::Iterations)].get<double>(),
      Draws ? "" : " per iteration",
      1e3 * Measured["chip_joules"]["value"].get<double>(),
      Measured["chip_um2"]["value"].get<double>() / 1e6,
      Measured[ClockedMachineKey].get<std::string>());
}

} // namespace vorion::splat
