#include "explore/Study.h"

#include "explore/Bottleneck.h"
#include "io/Hash.h"
#include "io/Inside.h"
#include "sweep/Process.h"
#include "vorion/support/JsonShape.h"

#include <filesystem>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

namespace {

/// What differs from the base, as one text.
std::string differenceOf(const Space &S, const Choices &C) {
  return fmt::format("{} {}", settingsOf(S, C),
                     fmt::join(argumentsOf(S, C), " "));
}

Origin originOf(const StudyPlan &P, const Trial &Of) {
  Origin From = P.From;
  From["view"] = hashView(*Of.View);
  From["settings"] = differenceOf(P.Parameters, Of.Machine);
  return From;
}

/// Of what runSplat() says, the program's own words.
std::string reasonIn(const std::string &What) {
  constexpr std::string_view Before = "splat: error: ";
  const std::size_t At = What.find(Before);
  return At == What.npos ? What : What.substr(At + Before.size());
}

class TrialMeasurement {
public:
  TrialMeasurement(const StudyPlan &Plan, const Trial &Target)
      : Plan(Plan), Target(Target),
        Base(fmt::format("{}/work/{}", Plan.Folder,
                         asFileName(Target.name(Plan.Parameters)))) {}

  Expected<Json> measure();

private:
  Json head() const;

  const StudyPlan &Plan;
  const Trial &Target;
  const std::string Base;
};

Json TrialMeasurement::head() const {
  return {{"machine", nameOf(Plan.Parameters, Target.Machine)},
          {"settings", settingsOf(Plan.Parameters, Target.Machine)},
          {"arguments", argumentsOf(Plan.Parameters, Target.Machine)},
          {"view", Target.View->Name},
          {"width", Target.View->Width},
          {"height", Target.View->Height}};
}

Json stagesOf(const Json &Time) {
  Json All = Json::array();
  for (const Json &Stage : Time["stages"])
    if (Stage["of_the_frame"].get<bool>() && Stage.contains("time")) {
      const Json &Of = Stage["time"];
      const Bottleneck Most = bottleneckOf(Of);
      const Roof Under = roofOf(Of, Most);
      All.push_back({{"name", Stage["name"]},
                     {"cycles", Of["cycles"]},
                     {"unit", Most.Unit},
                     {"reason", Most.Reason},
                     {"share", Most.Share},
                     {"work_share", Under.Work},
                     {"memory_share", Under.Memory}});
    }
  return All;
}

Expected<Json> TrialMeasurement::measure() {
  const std::string Picture = Base + ".png", ReportFile = Base + ".json",
                    LogFile = Base + ".log";
  std::vector<std::string> Words{
      "render", Plan.ScenePath,    "--cameras", Target.Of->CameraFile,
      "--view", Target.View->Name, "-o",        Picture,
      "--json", ReportFile,        "--energy"};
  for (const auto &More :
       {Plan.CommonArguments, argumentsOf(Plan.Parameters, Target.Machine)})
    Words.insert(Words.end(), More.begin(), More.end());
  if (!Plan.Technology.empty())
    Words.insert(Words.end(), {"--technology", Plan.Technology});
  if (Plan.Volts)
    Words.insert(Words.end(), {"--voltage", fmt::format("{}", *Plan.Volts)});
  if (auto Done = runSplat(
          Words,
          changed(Plan.Machine, settingsOf(Plan.Parameters, Target.Machine)),
          LogFile);
      !Done) {
    // By a setting, or by an option: what the base has is right.
    if (Done.error().Code != ExitCode::Usage ||
        nameOf(Plan.Parameters, Target.Machine) == "base")
      return Done.error();
    std::filesystem::remove(LogFile);
    Json Refused = head();
    Refused["refused"] = reasonIn(Done.error().What);
    return Refused;
  }
  const auto Report = readJson(ReportFile);
  if (!Report)
    return Report.error();
  for (const char *Ending : {".png", ".json", ".log"})
    std::filesystem::remove(Base + Ending);
  const Json &Time = (*Report)["time"], &Energy = (*Report)["energy"];
  Json Result = head();
  Result.update({{"picture", (*Report)["result_fnv1a64"]},
                 {"frame_ms", Time["frame_ms"]},
                 {"cycles", Time["sum"]["cycles"]},
                 {"chip_joules", Energy["chip_joules"]},
                 {"joules", Energy["joules"]},
                 {"chip_um2", Energy["area"]["chip_um2"]},
                 {"stages", stagesOf(Time)}});
  return Result;
}

/// Whether \p J has what measured() and the page take.
bool isMeasurement(const Json &J) {
  const JsonShape Number = JsonShape::number(), Text = JsonShape::text();
  const JsonShape Head = JsonShape::object(
      {{"machine", Text}, {"settings", Text}, {"view", Text}});
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
  const JsonShape Shape =
      JsonShape::object({{"picture", Text},
                         {"frame_ms", Number},
                         {"cycles", Number},
                         {"chip_joules", Interval},
                         {"joules", Interval},
                         {"chip_um2", Interval},
                         {"stages", JsonShape::list(Stage)}});
  return bool(Shape.check(J, ""));
}

std::string described(const Json &M) {
  if (M.contains("refused"))
    return "cannot be: " + M["refused"].get<std::string>();
  return fmt::format("{}: {:.3f} ms, chip {:.3g} mJ, {:.2f} mm2",
                     M["machine"].get<std::string>(),
                     M["frame_ms"].get<double>(),
                     1e3 * M["chip_joules"]["value"].get<double>(),
                     M["chip_um2"]["value"].get<double>() / 1e6);
}

} // namespace

DeviceOptions changed(DeviceOptions Base, const std::string &Settings) {
  const std::string Before = Base.text("VORION_SET");
  Base.set("VORION_SET",
           Before + (Before.empty() || Settings.empty() ? "" : ",") + Settings,
           Base.giver("VORION_SET"));
  return Base;
}

std::string Trial::name(const Space &S) const {
  const bool IsBase = nameOf(S, Machine) == "base";
  return fmt::format("{}@{}{}",
                     IsBase ? "base"
                            : fnv1a64(differenceOf(S, Machine)).substr(0, 12),
                     View->Name, Of->Suffix);
}

std::vector<Trial> trialsOf(const ViewSet &Of,
                            const std::vector<Choices> &Machines) {
  std::vector<Trial> All;
  for (const Choices &C : Machines)
    for (const Camera &View : Of.Views)
      All.push_back({C, &Of, &View});
  return All;
}

KeptPoints keptTrials(const StudyPlan &P,
                      std::function<void(std::string_view)> Log) {
  return {P.Folder, isMeasurement, std::move(Log)};
}

std::vector<Trial> missing(const StudyPlan &P, KeptPoints &Kept,
                           const std::vector<Trial> &Of) {
  std::vector<Trial> Left;
  for (const Trial &One : Of)
    if (!Kept.find(One.name(P.Parameters), originOf(P, One)))
      Left.push_back(One);
  return Left;
}

Expected<Success> measure(const StudyPlan &P, KeptPoints &Kept,
                          const std::vector<Trial> &Trials,
                          const std::function<void(std::string_view)> &Log) {
  std::vector<Measuring> Wanted;
  Wanted.reserve(Trials.size());
  for (const Trial &Of : Trials)
    Wanted.push_back({Of.name(P.Parameters), originOf(P, Of),
                      [&P, &Of] { return TrialMeasurement(P, Of).measure(); },
                      described});
  return measureAll(Kept, Wanted, P.Jobs, Log);
}

Expected<Measured> measured(const StudyPlan &P, KeptPoints &Kept,
                            const ViewSet &Of, const Choices &Machine) {
  Measured M{Machine, "", {}, {}};
  double Milliseconds = 0;
  for (const Camera &View : Of.Views) {
    const Trial One{Machine, &Of, &View};
    const Json *Found = Kept.find(One.name(P.Parameters), originOf(P, One));
    if (!Found)
      return Error{P.Folder,
                   fmt::format("trial {} is missing, expected it to be "
                               "measured",
                               One.name(P.Parameters))};
    M.Views.push_back(*Found);
    if (Found->contains("refused")) {
      M.Refused = (*Found)["refused"].get<std::string>();
      continue;
    }
    Milliseconds += (*Found)["frame_ms"].get<double>();
    M.Is.Joules += (*Found)["chip_joules"]["value"].get<double>();
    M.Is.Area = (*Found)["chip_um2"]["value"].get<double>() / 1e6;
  }
  const auto Count = static_cast<double>(Of.Views.size());
  M.Is.Rate = 1e3 * Count / Milliseconds;
  M.Is.Joules /= Count;
  return M;
}

} // namespace vorion::splat
