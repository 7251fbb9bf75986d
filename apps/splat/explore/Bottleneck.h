/// What a stage of a frame waits for.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// The reason of most cycles (docs/time-report.md, "Cycles by reason").
struct Bottleneck {
  std::string Unit;   ///< "cores" or "rasterizers"
  std::string Reason; ///< as the time report calls it
  double Share = 0;   ///< of the unit's cycles that are not idle or ended
};

/// Time reports of one stage, which may have run several times.
using StageTimes = std::vector<const nlohmann::ordered_json *>;

/// Of the cores; where these mostly wait for rasterizers, of the rasterizers.
Bottleneck bottleneckOf(const StageTimes &Runs);

/// A stage under its roofline: how much of the most that is possible its unit
/// did and DRAM moved, each 0 to 1. Where the first is below the second, DRAM
/// is the lower roof.
struct Roof {
  double Work = 0;   ///< cores: cycles with an issue; rasterizers: lane slots
  double Memory = 0; ///< of DRAM's bandwidth
};
Roof roofOf(const StageTimes &Runs, const Bottleneck &Of);

} // namespace vorion::splat
