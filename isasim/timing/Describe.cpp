#include "raster/ExpUnits.h"
#include "timing/DatapathUnits.h"
#include "vorion/isasim/Timing.h"

#include <fmt/format.h>

namespace vorion::isasim {

/// The groups' descriptions, in the order of the list.
static constexpr std::pair<std::string_view, std::string_view> Groups[] = {
#define GROUP(NAME, MEMBER, WHAT) {#NAME, WHAT},
#define PARAM(GROUP, OF, NAME, MEMBER, DEFAULT, LOW, HIGH, UNIT, SOURCE)
#include "vorion/isasim/TimingParams.def"
#undef GROUP
#undef PARAM
};

std::string timingMarkdown() {
  std::string Text;
  for (const auto &[Group, What] : Groups) {
    Text += fmt::format("\n`timing.{}`: {}\n\n"
                        "| parameter | default | unit | source |\n"
                        "|---|--:|---|---|\n",
                        Group, What);
    for (const TimingParam &P : timingParams())
      if (P.Group == Group)
        Text += fmt::format("| `{}` | {} | {} | {} |\n", P.Name, P.Default,
                            P.Unit, P.Source);
  }
  Text +=
      "\nUnits of a rasterizer's lane\n\n"
      "| unit | latency | interval | fp32 multipliers | fp32 adders | table "
      "bits | source |\n|---|--:|--:|--:|--:|--:|---|\n";
  const auto Row = [&Text](const DatapathUnit &U) {
    Text +=
        fmt::format("| {} | {} | {} | {} | {} | {} | {} |\n", U.Name, U.Latency,
                    U.Interval, U.Multipliers, U.Adders, U.TableBits, U.Source);
  };
  for (size_t Exp = 0; Exp != raster::expUnits().size(); ++Exp)
    for (const DatapathUnit &U : datapathUnits(static_cast<unsigned>(Exp)))
      // What is not an exponential unit is the same in every lane.
      if (Exp == 0 || U.Name == raster::expUnits()[Exp].Name)
        Row(U);
  return Text;
}

} // namespace vorion::isasim
