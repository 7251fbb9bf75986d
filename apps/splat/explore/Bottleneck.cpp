#include "explore/Bottleneck.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// Of the \p Units of \p Runs, whose entries have \p Reasons among others.
static Bottleneck mostOf(const StageTimes &Runs, const std::string &Units,
                         const std::set<std::string> &Reasons) {
  std::map<std::string, double> Cycles;
  double All = 0;
  for (const Json *Time : Runs)
    for (const Json &Unit : (*Time)[Units])
      for (const std::string &Reason : Reasons) {
        const double Count = Unit[Reason].get<double>();
        Cycles[Reason] += Count;
        All += Count;
      }
  Bottleneck Most{Units, "", 0};
  for (const auto &[Reason, Count] : Cycles)
    if (All > 0 && Count / All > Most.Share)
      Most = {Units, Reason, Count / All};
  return Most;
}

Bottleneck bottleneckOf(const StageTimes &Runs) {
  Bottleneck OfCores =
      mostOf(Runs, "cores",
             {"issue", "start", "fetch", "operand", "memory", "local", "unit",
              "lsu_queue", "branch", "divergence", "fence", "raster_full",
              "raster_wait", "barrier"});
  if (!OfCores.Reason.starts_with("raster_"))
    return OfCores;
  return mostOf(
      Runs, "rasterizers",
      {"blend", "clip", "fetch", "hazard", "begin", "flush", "drain"});
}

/// What a unit of the reports' activities counts; of any event, if that is
/// empty.
static double countOf(const StageTimes &Runs, std::string_view Unit,
                      std::string_view Event = {}) {
  double Sum = 0;
  for (const Json *Time : Runs)
    for (const Json &A : (*Time)["activities"])
      if (A["unit"] == Unit && (Event.empty() || A["event"] == Event))
        Sum += A["count"].get<double>();
  return Sum;
}

Roof roofOf(const StageTimes &Runs, const Bottleneck &Of) {
  const bool OnCores = Of.Unit == "cores";
  double Done = 0, Moved = 0;
  for (const Json *Time : Runs) {
    for (const Json &Unit : (*Time)[Of.Unit])
      Done += Unit[OnCores ? "issue" : "lane_slots"].get<double>();
    Moved += 1e-6 * (*Time)["dram"]["bus_ps"].get<double>() *
             (*Time)["clock_mhz"].get<double>();
  }
  const double Most =
      countOf(Runs, "time", OnCores ? "cores" : "rasterizer lanes");
  // Cycles of all channels, and of those with data.
  const double Channels = countOf(Runs, "dram channels");
  return {Most > 0 ? Done / Most : 0, Channels > 0 ? Moved / Channels : 0};
}

} // namespace vorion::splat
