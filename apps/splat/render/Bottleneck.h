/// The bottleneck of a stage of a frame.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// The reason with the most cycles (docs/time-report.md, "Cycles by reason").
struct Bottleneck {
  std::string Unit;   ///< "cores" or "rasterizers"
  std::string Reason; ///< its name in the time report
  double Share = 0;   ///< fraction of the unit's cycles that are not idle or
                      ///< ended
  /// The key of the machine's configuration, or its beginning, of which more
  /// shortens the wait; empty for none.
  std::string Helps;
};

/// Time reports of one stage, which may have run several times.
using StageTimes = std::vector<const nlohmann::ordered_json *>;

/// The bottleneck of the cores, or of the rasterizers if the cores mostly wait
/// for these.
Bottleneck bottleneckOf(const StageTimes &Runs);

/// A stage in the roofline model: the rates of its unit and of DRAM as
/// fractions of their peaks, each 0 to 1. If the first is below the second,
/// DRAM is the lower roof.
struct Roof {
  double Work = 0;   ///< cores: cycles with an issue; rasterizers: lane slots
  double Memory = 0; ///< fraction of the DRAM bandwidth
};
Roof roofOf(const StageTimes &Runs, const Bottleneck &Of);

} // namespace vorion::splat
