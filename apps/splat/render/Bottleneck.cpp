#include "render/Bottleneck.h"

#include "splat/ClockCounts.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>

namespace vorion::splat {

using Json = nlohmann::ordered_json;

/// Of the \p Units of \p Runs, which count \p Count: the reason of most cycles
/// that were not idle, and where it is, its group.
template <typename Count>
static std::pair<Bottleneck, ReasonGroup> mostOf(const StageTimes &Runs,
                                                 const std::string &Units) {
  std::array<double, Reasons<Count>.size()> Cycles{};
  double All = 0;
  for (const Json *Time : Runs)
    for (const Json &Unit : (*Time)[Units])
      for (std::size_t N = 0; N != Cycles.size(); ++N)
        if (!Reasons<Count>[N].IsIdle) {
          const double Spent =
              Unit[std::string(CountNames<Count>[N])].template get<double>();
          Cycles[N] += Spent;
          All += Spent;
        }
  const auto Most = std::ranges::max_element(Cycles);
  if (All == 0)
    return {{Units, "", 0, ""}, {}};
  const auto N = static_cast<std::size_t>(Most - Cycles.begin());
  return {{Units, std::string(CountNames<Count>[N]), *Most / All,
           std::string(Reasons<Count>[N].Helps)},
          Reasons<Count>[N].Group};
}

Bottleneck bottleneckOf(const StageTimes &Runs) {
  const auto &[OfCores, Group] = mostOf<CoreCount>(Runs, "cores");
  if (Group != ReasonGroup::CoreRasterizes)
    return OfCores;
  return mostOf<RasterCount>(Runs, "rasterizers").first;
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
