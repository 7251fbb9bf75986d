/// Counters of all runs of a session, for people and as JSON. Needs no observed
/// run: the machine counts anyway.
#pragma once

#include "vorion/isasim/Config.h"
#include "vorion/isasim/Result.h"

#include <string>
#include <vector>

namespace vorion::isasim {

class Stats {
public:
  void setConfig(const Config &C) { Machine = toJson(C); }
  void add(const std::string &Name, const RunResult &R);

  /// {"format", "config", "total", "raster", "host_seconds",
  /// "host_cpu_seconds": sums over runs, "runs": [what toJson(RunResult) has,
  /// with "name"]}.
  std::string json() const;
  /// A line a counter, totals of one run only.
  static std::string table(const RunResult &R);

private:
  std::string Machine;
  RunResult Sum;
  std::vector<std::string> Runs; ///< JSON objects
};

} // namespace vorion::isasim
