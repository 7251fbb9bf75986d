#include "explore/Bottleneck.h"

#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// Of the \p Units of \p Time, whose entries have \p Reasons among others.
static Bottleneck mostOf(const Json &Time, const std::string &Units,
                         const std::set<std::string> &Reasons) {
  std::map<std::string, double> Cycles;
  double All = 0;
  for (const Json &Unit : Time[Units])
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

Bottleneck bottleneckOf(const Json &Time) {
  Bottleneck OfCores =
      mostOf(Time, "cores",
             {"issue", "start", "fetch", "operand", "memory", "local", "unit",
              "lsu_queue", "branch", "divergence", "fence", "raster_full",
              "raster_wait", "barrier"});
  if (!OfCores.Reason.starts_with("raster_"))
    return OfCores;
  return mostOf(
      Time, "rasterizers",
      {"blend", "clip", "fetch", "hazard", "begin", "flush", "drain"});
}

} // namespace vorion::splat
