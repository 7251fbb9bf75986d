#include "tools/StatsTable.h"

#include <fmt/format.h>
#include <utility>

namespace vorion::isasim {

std::string statsTable(const RunResult &R) {
  std::string Text = fmt::format("{:<24}{:>16}\n", "outcome", describe(R.End));
  const std::pair<const char *, uint64_t> Lines[] = {
      {"warp instructions", R.Total.WarpInstructions},
      {"lane instructions", R.Total.LaneInstructions},
      {"loads", R.Total.Loads},
      {"stores", R.Total.Stores},
      {"atomics", R.Total.Atomics},
      {"splits", R.Total.Splits},
      {"divergent splits", R.Total.DivergentSplits},
      {"parked operations", R.Total.Parks},
      {"raster commands", R.Raster.Commands},
      {"raster Gaussians", R.Raster.Gaussians},
      {"raster clipped", R.Raster.Clipped},
      {"raster fragments", R.Raster.Fragments},
      {"raster blends", R.Raster.Blends},
      {"sync points", R.SyncPoints},
  };
  for (const auto &[Name, Value] : Lines)
    Text += fmt::format("{:<24}{:>16}\n", Name, Value);
  Text += fmt::format("{:<24}{:>14.3f} s\n", "host time", R.HostSeconds);
  return Text;
}

} // namespace vorion::isasim
