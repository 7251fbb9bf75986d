#include "accuracy/TrainSweep.h"

#include "accuracy/GradientReference.h"
#include "capture/Capture.h"
#include "device/ClockedMachine.h"
#include "io/Hash.h"
#include "io/Inside.h"
#include "io/Mean.h"
#include "scene/SceneFile.h"
#include "study/Process.h"
#include "vorion/support/Json.h"
#include "vorion/support/JsonShape.h"
#include "vorion/support/Printable.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

constexpr const char *GradientPoint = "gradients";

std::string references(const TrainSweepPlan &P) {
  return P.Folder + "/references";
}

std::string stateFile(const TrainSweepPlan &P) {
  return references(P) + "/state.ply";
}

std::string background(const TrainSweepPlan &P) {
  return fmt::format("{}", fmt::join(P.Background, ","));
}

/// Of every `splat train`.
std::vector<std::string> trainArguments(const TrainSweepPlan &P,
                                        const std::string &Output) {
  std::vector<std::string> Words{"train",        P.Capture,
                                 "-o",           Output,
                                 "--iterations", std::to_string(P.Iterations),
                                 "--downscale",  std::to_string(P.Downscale),
                                 "--background", background(P)};
  for (const std::string &Name : P.Exclude)
    Words.insert(Words.end(), {"--exclude", Name});
  if (P.AllowOutside)
    Words.emplace_back("--allow-outside");
  if (P.MostGaussians != 0)
    Words.insert(Words.end(),
                 {"--max-gaussians", std::to_string(P.MostGaussians)});
  return Words;
}

/// The scene at which gradients are compared: the default's run with seed 0.
Expected<Success> makeState(const TrainSweepPlan &P,
                            const std::function<void(std::string_view)> &Log) {
  return makeOnce({stateFile(P)}, P.From, [&]() -> Expected<Success> {
    Log("scene for gradients: run of the default with seed 0");
    std::vector<std::string> Words = trainArguments(P, stateFile(P));
    // A run that was broken off goes on, unless it was made from other things.
    const std::string Checkpoint =
        fmt::format("{}/state-{}.checkpoint", references(P),
                    fnv1a64(fmt::format("{}", P.From)));
    Words.insert(Words.end(), {"--resume", "--checkpoint-every", "50",
                               "--checkpoint", Checkpoint});
    const auto Done = runSplat(Words, P.Machine, references(P) + "/state.log");
    if (!Done)
      return Done.error();
    std::filesystem::remove(Checkpoint);
    return Success{};
  });
}

/// That scene and its reference.
Expected<Success>
makeReference(const TrainSweepPlan &P,
              const std::function<void(std::string_view)> &Log) {
  if (auto Made = makeState(P, Log); !Made)
    return Made;
  const GradientFiles Files(references(P));
  const auto Make = [&]() -> Expected<Success> {
    auto State = readScene(stateFile(P));
    if (!State)
      return State.error();
    const auto C = readCapture(P.Capture, {P.Exclude, P.AllowOutside});
    if (!C)
      return C.error();
    const auto Pictures = loadTrainingSet(*C, {P.Downscale, P.Background});
    if (!Pictures)
      return Pictures.error();
    Log("reference gradients in fp64");
    return writeGradientReference(Files, std::move(State->Gaussians),
                                  Pictures->Training.front(), P.Background);
  };
  return makeOnce({Files.Gradients, Files.Upstream, Files.Cameras}, P.From,
                  Make);
}

/// The rasterizer's units alone: their values, without the path.
std::vector<std::string> unitArguments(const Setting &S) {
  std::vector<std::string> Words;
  for (const Knob &K : trainKnobs())
    Words.insert(Words.end(), {"--" + K.Name, S.value(K.Id)});
  return Words;
}

Expected<Json> measureGradients(const TrainSweepPlan &P, const TrainPoint &Of,
                                const std::string &Base) {
  const GradientFiles Files(references(P));
  std::vector<std::string> Words{"gradients",   stateFile(P),   "--cameras",
                                 Files.Cameras, "--view",       Files.View,
                                 "--upstream",  Files.Upstream, "-o",
                                 Base + ".npz", "--background", background(P)};
  const auto Units = unitArguments(Of.Chosen);
  Words.insert(Words.end(), Units.begin(), Units.end());
  if (auto Done = runSplat(Words, P.Machine, Base + ".log"); !Done)
    return Done.error();
  auto Errors = gradientErrors(Files, Base + ".npz");
  if (!Errors)
    return Errors;
  for (const char *Ending : {".npz", ".log"})
    std::filesystem::remove(Base + Ending);
  return Json{{"setting", Of.Chosen.name()}, {"errors", std::move(*Errors)}};
}

/// Machine-seconds after each scored iteration. An iteration that was not timed
/// takes what the timed one of its block takes, or the last that there is.
Json curveOf(const Json &Report, unsigned TimeEvery) {
  const Json &Timed = Report["timed"];
  std::vector<double> ByBlock;
  for (const Json &T : Timed) {
    const std::size_t Block = (T["iteration"].get<unsigned>() - 1) / TimeEvery;
    ByBlock.resize(Block + 1, T["time"]["frame_ms"].get<double>());
  }
  Json Curve = Json::array();
  double Seconds = 0;
  unsigned Done = 0;
  for (const Json &S : Report["scores"]) {
    for (; Done < S["iteration"].get<unsigned>(); ++Done)
      Seconds +=
          1e-3 *
          ByBlock[std::min<std::size_t>(Done / TimeEvery, ByBlock.size() - 1)];
    Curve.push_back({{"iteration", Done},
                     {"machine_seconds", Seconds},
                     {"psnr8_db", S["psnr8_db"]}});
  }
  return Curve;
}

Expected<Json> measureRun(const TrainSweepPlan &P, const TrainPoint &Of,
                          const std::string &Base) {
  std::vector<std::string> Words = trainArguments(P, Base + ".ply");
  const auto Units = unitArguments(Of.Chosen);
  Words.insert(Words.end(), Units.begin(), Units.end());
  Words.insert(Words.end(),
               {"--seed", std::to_string(*Of.Seed), "--time", "--time-every",
                std::to_string(P.TimeEvery), "--score-every",
                std::to_string(P.ScoreEvery), "--checkpoint", "/dev/null"});
  if (P.Energy)
    Words.emplace_back("--energy");
  auto Done = runForReport(std::move(Words), P.Machine, Base);
  if (!Done)
    return Done.error();
  for (const char *Ending : {".ply", ".cameras.json"})
    std::filesystem::remove(Base + Ending);
  Json &Report = Done->Report;
  if (Report["timed"].empty())
    return Error{
        Of.name(),
        "no iteration was timed, expected the clock on for the whole run",
        ExitCode::Usage};
  Json Curve = curveOf(Report, P.TimeEvery);
  double Cycles = 0, Joules = 0;
  for (const Json &T : Report["timed"]) {
    Cycles += T["time"]["sum"]["cycles"].get<double>();
    if (P.Energy)
      Joules += T["energy"]["chip_joules"]["value"].get<double>();
  }
  const Json &First = Report["timed"].front()["time"]["sum"];
  const Json Areas = First["lane_areas"]["reciprocal"];
  std::string On = clockedMachine(First);
  const std::size_t Samples = Report["timed"].size();
  // Seconds of the host, of one run, are no figure.
  for (const char *Key : {"losses", "scores", "seconds", "timed"})
    Report.erase(Key);
  return Json{
      {"setting", Of.Chosen.name()},
      {"seed", Of.at()},
      {ClockedMachineKey, std::move(On)},
      {"psnr8_db", Report["psnr8_db"]},
      {"timed", Samples},
      {"cycles", Cycles / double(Samples)},
      {"chip_joules", P.Energy ? Json(Joules / double(Samples)) : Json()},
      {"reciprocal_um2", Areas},
      {"curve", std::move(Curve)},
      {"made_by", std::move(Report)}};
}

/// Whether \p J has what trainResults() and the page take.
bool isMeasurement(const Json &J) {
  const JsonShape Number = JsonShape::number(), Text = JsonShape::text();
  const JsonShape Errors = JsonShape::object({{"means", Number},
                                              {"quats", Number},
                                              {"scales", Number},
                                              {"opacities", Number},
                                              {"colors", Number},
                                              {"largest", Number}});
  const JsonShape Gradients =
      JsonShape::object({{"setting", Text}, {"errors", Errors}});
  const JsonShape Curve =
      JsonShape::list(JsonShape::object({{"iteration", Number},
                                         {"machine_seconds", Number},
                                         {"psnr8_db", Number}}),
                      1);
  const JsonShape Run = JsonShape::object(
      {{"setting", Text},
       {"seed", Text},
       {ClockedMachineKey, Text},
       {"psnr8_db", Number},
       {"cycles", Number},
       {"chip_joules", Number.orNull()},
       {"reciprocal_um2",
        JsonShape::list(Number, knob(KnobId::Reciprocal).Values.size())},
       {"curve", Curve}});
  const bool OfGradients = J.contains("errors");
  if (!(OfGradients ? Gradients : Run).check(J, ""))
    return false;
  const std::string At =
      OfGradients ? GradientPoint : J["seed"].get<std::string>();
  return (At == GradientPoint) == OfGradients &&
         J["point"] == J["setting"].get<std::string>() + "@" + At;
}

std::string lineOf(const Json &Measured) {
  if (Measured.contains("errors"))
    return fmt::format("{:.1e}", Measured["errors"]["largest"].get<double>());
  return fmt::format("{:.2f} dB, {:.0f} cycles per iteration; {}",
                     Measured["psnr8_db"].get<double>(),
                     Measured["cycles"].get<double>(),
                     Measured[ClockedMachineKey].get<std::string>());
}

} // namespace

std::string TrainPoint::at() const {
  return Seed ? fmt::format("seed{}", *Seed) : GradientPoint;
}

std::vector<TrainPoint> trainPoints(const TrainSweepPlan &P) {
  const std::vector<Setting> Settings = singleChanges(trainKnobs());
  std::vector<TrainPoint> All;
  All.reserve(Settings.size() * (std::size_t{P.Seeds} + 1));
  for (const Setting &S : Settings)
    All.push_back({S, std::nullopt});
  for (unsigned Seed = 0; Seed < P.Seeds; ++Seed)
    for (const Setting &S : Settings)
      All.push_back({S, Seed});
  return All;
}

Expected<Provenance> provenanceOf(const TrainSweepPlan &P, const Capture &C) {
  auto From = commonProvenance(P.Machine);
  if (!From)
    return From;
  auto Hash = hashCapture(C);
  if (!Hash)
    return Hash.error();
  if (P.Energy)
    From->insert({"energy", "chip"});
  From->insert({{"capture", std::move(*Hash)},
                {"downscale", std::to_string(P.Downscale)},
                {"background", background(P)},
                {"max_gaussians", std::to_string(P.MostGaussians)},
                {"iterations", std::to_string(P.Iterations)},
                {"score_every", std::to_string(P.ScoreEvery)},
                {"time_every", std::to_string(P.TimeEvery)}});
  return From;
}

std::vector<StudyPoint>
studyPoints(const TrainSweepPlan &P, const std::vector<TrainPoint> &Points,
            const std::function<void(std::string_view)> &Log) {
  std::vector<StudyPoint> All;
  All.reserve(Points.size());
  for (const TrainPoint &Of : Points) {
    const std::string Base =
        fmt::format("{}/work/{}", P.Folder, asFileName(Of.name()));
    StudyPoint &One = All.emplace_back();
    One.Name = Of.name();
    One.From = P.From;
    One.Describe = lineOf;
    if (Of.Seed) {
      One.Measure = [&P, Of, Base] { return measureRun(P, Of, Base); };
      continue;
    }
    One.Prepare = [&P, Log] { return makeReference(P, Log); };
    One.Measure = [&P, Of, Base] { return measureGradients(P, Of, Base); };
  }
  return All;
}

PointStore storeOf(const TrainSweepPlan &P,
                   std::function<void(std::string_view)> Log) {
  return {P.Folder, isMeasurement, std::move(Log)};
}

namespace {

/// Mean, and least and most.
Json spreadOf(const std::vector<double> &Values) {
  if (Values.empty())
    return {};
  const auto [Least, Most] = std::ranges::minmax(Values);
  return {{"mean", meanOf(Values)}, {"least", Least}, {"most", Most}};
}

/// Machine-seconds until a curve has \p Db, between scores by a line; the last
/// score's if it never does.
double secondsUntil(const Json &Curve, double Db) {
  double Before = 0, Had = -std::numeric_limits<double>::infinity();
  for (const Json &At : Curve) {
    const double Seconds = At["machine_seconds"].get<double>();
    const double Has = At["psnr8_db"].get<double>();
    if (Has >= Db)
      return Had > -1e9 ? Before + (Seconds - Before) * (Db - Had) / (Has - Had)
                        : Seconds;
    Before = Seconds;
    Had = Has;
  }
  return Before;
}

double bestOf(const Json &Curve) {
  double Best = -std::numeric_limits<double>::infinity();
  for (const Json &At : Curve)
    Best = std::max(Best, At["psnr8_db"].get<double>());
  return Best;
}

} // namespace

Expected<Json> trainResults(const TrainSweepPlan &P, PointStore &Kept) {
  Json Points = Json::array(), On;
  double Reached = std::numeric_limits<double>::infinity();
  const std::vector<TrainPoint> All = trainPoints(P);
  for (const TrainPoint &Of : All) {
    auto One = Kept.get(Of.name(), P.From);
    if (!One)
      return One.error();
    if (Of.Seed) {
      Reached = std::min(Reached, bestOf((*One)["curve"]));
      // No setting changes the machine.
      On = (*One)[ClockedMachineKey];
    }
    Points.push_back(std::move(*One));
  }
  Json Settings = Json::array();
  for (const Setting &S : singleChanges(trainKnobs())) {
    Json Row{{"setting", S.name()}};
    std::vector<double> Cycles, Joules, Db, Seconds;
    for (std::size_t I = 0; I != All.size(); ++I) {
      if (All[I].Chosen != S)
        continue;
      const Json &One = Points[I];
      if (!All[I].Seed) {
        Row["gradient_error"] = One["errors"];
        continue;
      }
      Cycles.push_back(One["cycles"].get<double>());
      if (!One["chip_joules"].is_null())
        Joules.push_back(One["chip_joules"].get<double>());
      Db.push_back(One["psnr8_db"].get<double>());
      Seconds.push_back(secondsUntil(One["curve"], Reached));
      Row["reciprocal_um2"] =
          One["reciprocal_um2"].at(S.place(KnobId::Reciprocal));
    }
    Row["cycles"] = spreadOf(Cycles);
    Row["chip_joules"] = spreadOf(Joules);
    Row["psnr8_db"] = spreadOf(Db);
    Row["machine_seconds"] = spreadOf(Seconds);
    Settings.push_back(std::move(Row));
  }
  return Json{{"capture", P.Capture},       {ClockedMachineKey, std::move(On)},
              {"iterations", P.Iterations}, {"seeds", P.Seeds},
              {"reached_db", Reached},      {"settings", std::move(Settings)},
              {"points", std::move(Points)}};
}

std::string trainTable(const Json &Results) {
  const bool HasEnergy = !Results["settings"][0]["chip_joules"].is_null();
  std::string Text = fmt::format(
      "machine: {}\n\n"
      "| setting | gradient error | unit area, um^2 per pair | Mcycles per "
      "iteration | {}PSNR after {}, dB | machine-seconds to {:.2f} dB |\n"
      "|---|--:|--:|--:|{}--:|--:|\n",
      printable(Results[ClockedMachineKey].get<std::string>()),
      HasEnergy ? "chip energy per iteration, mJ | " : "",
      Results["iterations"].get<unsigned>(),
      Results["reached_db"].get<double>(), HasEnergy ? "--:|" : "");
  const auto Spread = [](const Json &J, double Unit, int Digits) {
    return fmt::format("{0:.{3}g} ({1:.{3}g} to {2:.{3}g})",
                       J["mean"].get<double>() / Unit,
                       J["least"].get<double>() / Unit,
                       J["most"].get<double>() / Unit, Digits);
  };
  for (const Json &Row : Results["settings"])
    Text += fmt::format(
        "| {} | {:.1e} | {:.0f} | {} | {}{} | {} |\n",
        Row["setting"].get<std::string>(),
        Row["gradient_error"]["largest"].get<double>(),
        Row["reciprocal_um2"].get<double>(), Spread(Row["cycles"], 1e6, 4),
        HasEnergy ? Spread(Row["chip_joules"], 1e-3, 4) + " | " : "",
        Spread(Row["psnr8_db"], 1, 4), Spread(Row["machine_seconds"], 1, 3));
  return Text;
}

} // namespace vorion::splat
