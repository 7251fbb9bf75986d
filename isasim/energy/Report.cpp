#include "energy/Costs.h"
#include "energy/Published.h"
#include "vorion/isasim/Energy.h"

#include <algorithm>
#include <fmt/format.h>
#include <functional>
#include <nlohmann/json.hpp>

namespace vorion::isasim {

using Json = nlohmann::ordered_json;

Json toJson(const Estimate &E) {
  return {{"value", E.Value}, {"low", E.Low}, {"high", E.High}};
}

Json toJson(const Energy &E, const Technology &T) {
  Json Units = Json::array();
  for (const UnitEnergy &U : E.Units)
    Units.push_back({{"unit", U.Name},
                     {"on_chip", U.OnChip},
                     {"joules", toJson(U.Joules)},
                     {"share", toJson(U.Share)}});
  return {{"technology", T.Name},
          {"volts", E.Volts},
          {"seconds", E.Seconds},
          {"joules", toJson(E.Total)},
          {"chip_joules", toJson(E.Chip)},
          {"watts", toJson(E.Watts)},
          {"chip_watts", toJson(E.ChipWatts)},
          {"units", Units}};
}

Json toJson(const Area &A) {
  Json Parts = Json::array();
  for (const PartArea &P : A.Parts)
    Parts.push_back({{"part", P.Name}, {"um2", toJson(P.Um2)}});
  return {{"chip_um2", toJson(A.Chip)}, {"parts", Parts}};
}

Json toJson(const std::vector<RowFactor> &Rows) {
  Json All = Json::array();
  for (const RowFactor &R : Rows)
    All.push_back({{"row", R.Row},
                   {"of", R.IsArea ? "area" : "energy"},
                   {"factor", toJson(R.Factor)}});
  return All;
}

std::string movedRowsText(std::vector<RowFactor> Rows, size_t Count) {
  const auto Moved = [](const RowFactor &R) {
    return std::max(R.Factor.Value, 1 / R.Factor.Value);
  };
  std::ranges::sort(Rows, std::greater<>(), Moved);
  Rows.resize(std::min(Rows.size(), Count));
  std::string Text;
  for (const RowFactor &R : Rows)
    Text += fmt::format("{:<7}{:<20}{:>10.2f}{:>10.2f}{:>10.2f}\n",
                        R.IsArea ? "area" : "energy", R.Row, R.Factor.Value,
                        R.Factor.Low, R.Factor.High);
  return Text;
}

/// What a chip of \p T cannot do at the voltage of \p E, as a line; empty if
/// there is nothing.
static std::string doubtOf(const Energy &E, const Technology &T) {
  if (E.Volts < T.LowVolts)
    return fmt::format("note: {:.3f} V is below {:g} V, the lower end of the "
                       "technology's frequency law\n",
                       E.Volts, T.LowVolts);
  const double Mhz = clockAt(T, E.Volts);
  if (E.ClockMhz > 1.01 * Mhz)
    return fmt::format("note: at {:.3f} V the technology's frequency law "
                       "allows {:.0f} MHz, and the clock is {}\n",
                       E.Volts, Mhz, E.ClockMhz);
  return "";
}

std::string toText(const Energy &E, const Technology &T) {
  constexpr double Milli = 1e3;
  std::string Text = fmt::format("{:<20}{:>12}{:>12}{:>12}{:>8}\n", "energy",
                                 "mJ", "5 %", "95 %", "%");
  const auto Row = [&Text](std::string_view Name, const Estimate &J,
                           double Share) {
    Text += fmt::format("{:<20}{:>12.4g}{:>12.4g}{:>12.4g}{:>8.1f}\n", Name,
                        Milli * J.Value, Milli * J.Low, Milli * J.High,
                        100 * Share);
  };
  const double Whole = E.Total.Value > 0 ? E.Total.Value : 1;
  for (const UnitEnergy &U : E.Units)
    Row(U.Name, U.Joules, U.Share.Value);
  Row("chip", E.Chip, E.Chip.Value / Whole);
  Row("all", E.Total, E.Total.Value / Whole);
  return Text +
         fmt::format("power: chip {:.3g} W ({:.3g} to {:.3g}), all {:.3g} W "
                     "({:.3g} to {:.3g}), {:.3f} V, technology {}\n",
                     E.ChipWatts.Value, E.ChipWatts.Low, E.ChipWatts.High,
                     E.Watts.Value, E.Watts.Low, E.Watts.High, E.Volts,
                     T.Name) +
         doubtOf(E, T);
}

std::string energyMarkdown(const Technology &T) {
  std::string Text = "| row | pJ | sigma | source |\n|---|--:|--:|---|\n";
  for (const TechnologyRow &R : T.Energies)
    Text += fmt::format("| {} | {:g}{} | {:g} | {} |\n", R.Name, R.Value,
                        R.Name == "leakage of a mm2" ? " mW" : "", R.Sigma,
                        R.Source);
  Text += "\n| row | um2 | sigma | source |\n|---|--:|--:|---|\n";
  for (const TechnologyRow &R : T.Areas)
    Text += fmt::format("| {} | {:g} | {:g} | {} |\n", R.Name, R.Value, R.Sigma,
                        R.Source);
  Text +=
      "\n| unit | event | counts to | row | times |\n|---|---|---|---|--:|\n";
  for (const EventCost &C : eventCosts())
    Text += fmt::format("| {} | {} | {} | {} | {:g} |\n", C.Unit, C.Event,
                        name(C.Of), C.Row, C.Count);
  Text += "\n| part | for each of | row | times |\n|---|---|---|--:|\n";
  for (const AreaCost &C : areaCosts())
    Text += fmt::format("| {} | {} | {} | {:g} |\n", C.Part, C.Event, C.Row,
                        C.Count);
  return Text + "\n" + publishedMarkdown(T);
}

} // namespace vorion::isasim
