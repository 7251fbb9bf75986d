/// Counters of all runs of a session, for people and as JSON. Needs no observed
/// run: the machine counts anyway.
#pragma once

#include "vorion/isasim/Config.h"
#include "vorion/isasim/Energy.h"
#include "vorion/isasim/Result.h"

#include <memory>
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

} // namespace vorion::isasim
