/// Counters of all runs of a session, for people and as JSON. Needs no observed
/// run: the machine counts anyway.
#include "observe/LaunchRecord.h"
#include "observe/Tool.h"
#include "vorion/isasim/Config.h"
#include "vorion/isasim/Energy.h"
#include "vorion/isasim/Machine.h"
#include "vorion/isasim/Result.h"
#include "vorion/support/File.h"
#include "vorion/support/Json.h"

#include <algorithm>
#include <fmt/format.h>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace vorion::isasim {

class Stats {
public:
  /// \p By is the model that counts joules. Null: the default technology's, at
  /// the voltage that the clock needs.
  explicit Stats(std::shared_ptr<const EnergyModel> By = nullptr)
      : Model(std::move(By)) {}
  void setConfig(const Config &C) { Machine = toJson(C); }
  /// \p Launch is what LaunchRecord says of it, a JSON object.
  void add(const std::string &Name, const std::string &Launch,
           const RunResult &R);

  /// {"format", "config", "total", "raster", "host_seconds",
  /// "host_cpu_seconds": sums over runs, "runs": [what toJson(RunResult) has,
  /// with "name" and "launch"]}. Where a run was timed, it and the sum have
  /// "energy".
  std::string json() const;
  /// A line a counter, totals of one run only.
  static std::string table(const RunResult &R);

private:
  std::string Machine;
  RunResult Sum;
  /// Of the runs that were timed; the default model is made with the first.
  EnergyWork Timed;
  std::shared_ptr<const EnergyModel> Model;
  std::vector<std::string> Runs; ///< JSON objects
};

using Json = nlohmann::ordered_json;

/// The clock's law may end below the clock, and the technology may not know
/// the DRAM: then there is no figure.
static Json energyJson(const EnergyModel &Model, const EnergyWork &Work) {
  const Expected<Energy> Spent = Model.energyOf(Work);
  return Spent ? toJson(*Spent, Model.technology()) : Json();
}

/// \p More is done after \p To.
static void add(EnergyWork &To, const EnergyWork &More) {
  To.Cycles += More.Cycles;
  To.ClockMhz = More.ClockMhz;
  for (const EventCount &E : More.Events) {
    const auto Same = std::ranges::find_if(To.Events, [&](const EventCount &O) {
      return O.Unit == E.Unit && O.Event == E.Event;
    });
    if (Same == To.Events.end())
      To.Events.push_back(E);
    else
      Same->Count += E.Count;
  }
}

void Stats::add(const std::string &Name, const std::string &Launch,
                const RunResult &R) {
  Sum.Total += R.Total;
  Sum.Raster += R.Raster;
  Sum.HostSeconds += R.HostSeconds;
  Sum.HostCpuSeconds += R.HostCpuSeconds;
  Json Run = {{"name", Name}, {"launch", ownJson<Json>(Launch)}};
  Run.update(ownJson<Json>(toJson(R)));
  if (R.Time) {
    EnergyWork Work{R.Time->Cycles, R.Time->ClockMhz, {}};
    for (const Activity &A : R.Time->Activities)
      Work.Events.push_back({A.Unit, A.Event, A.Count});
    if (!Model)
      if (auto Made = EnergyModel::create(defaultTechnology(), Work.ClockMhz,
                                          std::nullopt))
        Model = std::make_shared<EnergyModel>(std::move(*Made));
    if (Model)
      Run["energy"] = energyJson(*Model, Work);
    isasim::add(Timed, Work);
  }
  Runs.push_back(jsonText(Run));
}

std::string Stats::json() const {
  Json Object = {{"format", "vorion-stats 1"}};
  Object["config"] = ownJson<Json>(Machine);
  const Json All = ownJson<Json>(toJson(Sum));
  for (const char *Key :
       {"total", "raster", "host_seconds", "host_cpu_seconds"})
    Object[Key] = All[Key];
  if (Model)
    Object["energy"] = energyJson(*Model, Timed);
  Object["runs"] = Json::array();
  for (const std::string &Run : Runs)
    Object["runs"].push_back(ownJson<Json>(Run));
  return jsonText(Object, 2) + "\n";
}

std::string Stats::table(const RunResult &R) {
  std::string Text = fmt::format("{:<24}{:>16}\n", "outcome", describe(R.End));
  for (const NamedCounter &C : counters(R))
    Text += fmt::format("{:<24}{:>16}\n", fmt::format("{} {}", C.Group, C.Name),
                        C.Value);
  Text += fmt::format("{:<24}{:>16}\n", "sync points", R.SyncPoints);
  Text += fmt::format("{:<24}{:>14.3f} s\n", "host time", R.HostSeconds);
  return Text;
}

namespace {

class StatsTool : public Tool {
public:
  StatsTool(std::string FileIn, const ToolOutput &To)
      : File(std::move(FileIn)), Print(To.Print), Counts(To.Energy) {}
  Expected<Success> attach(Machine &M) override {
    Counts.setConfig(M.config());
    Device = &M;
    return Success{};
  }
  void memoryGiven(const std::vector<GivenMemory> &Given) override {
    Record.setGiven(Given);
  }
  void runBegins(const std::string &Name, uint32_t LaunchBlock) override {
    Launch = jsonText(Record.take(*Device, Name, LaunchBlock));
  }
  Expected<Success> runEnded(const std::string &Name,
                             const RunResult &R) override {
    Counts.add(Name, Launch, R);
    if (Print)
      Print(Stats::table(R));
    return writeFileAtomically(File, Counts.json());
  }

private:
  std::string File;
  std::function<void(std::string_view)> Print;
  Stats Counts;
  const Machine *Device = nullptr;
  LaunchRecord Record;
  std::string Launch; ///< of the run at hand
};

Expected<std::unique_ptr<Tool>> make(const std::string &Text,
                                     const ToolOutput &To) {
  return std::unique_ptr<Tool>(std::make_unique<StatsTool>(Text, To));
}

std::vector<NamedFile> outputs(const std::string &Text) {
  return {{"--stats", Text}};
}

} // namespace

const ToolKind tools::Stats{.Make = make, .Outputs = outputs};

} // namespace vorion::isasim
