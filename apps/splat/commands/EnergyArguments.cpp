#include "commands/EnergyArguments.h"

#include "vorion/support/CommandLine.h"

namespace vorion::splat {

void addEnergyOptions(CLI::App &App, EnergyArguments &A,
                      const std::string &What) {
  App.add_flag("--energy", A.Energy,
               "Say how much energy " + What +
                   " takes on the machine, and how sure that is "
                   "(docs/energy.md; turns --time on)");
  takesFile(
      App.add_option("--technology", A.Technology,
                     "Energies and areas (turns --energy on; default: 16 nm)"),
      {".json"});
  App.add_option(
         "--voltage", A.Volts,
         "The chip's (turns --energy on; default: what the clock needs)")
      ->option_text("V")
      ->check(isBetween(0.1, 5.0));
}

Expected<std::optional<EnergyRequest>>
requestedEnergy(const EnergyArguments &A, std::optional<unsigned> ClockMhz) {
  if (!A.isWanted())
    return std::optional<EnergyRequest>();
  EnergyRequest R{isasim::defaultTechnology(), A.Volts};
  if (!A.Technology.empty()) {
    auto Read = isasim::readTechnology(A.Technology);
    if (!Read)
      return Read.error();
    R.From = std::move(*Read);
  }
  if (ClockMhz)
    if (const auto Fits =
            isasim::EnergyModel::create(R.From, *ClockMhz, R.Volts);
        !Fits)
      return Fits.error();
  return std::optional(std::move(R));
}

} // namespace vorion::splat
