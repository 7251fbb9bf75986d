#include "commands/EnergyArguments.h"

#include "vorion/support/CommandLine.h"

namespace vorion::splat {

void addEnergyOptions(CLI::App &App, EnergyArguments &A,
                      const std::string &What) {
  const HelpGroup Group(App, "Time and energy");
  App.add_flag("--energy", A.Energy,
               "Report the modelled energy of " + What +
                   " with its uncertainty (docs/energy.md; implies --time)");
  takesFile(App.add_option("--technology", A.Technology,
                           "Energies and areas of a process node (implies "
                           "--energy; default: 16 nm)"),
            {".json"});
  App.add_option("--voltage", A.Volts,
                 "Supply voltage (implies --energy; default: what the clock "
                 "frequency needs)")
      ->option_text("V");
  App.add_flag("--given-chip", A.GivenChip,
               "Also estimate it given the published area and power of the "
               "technology's chip (implies --energy)");
}

Expected<std::optional<EnergyRequest>>
requestedEnergy(const EnergyArguments &A, std::optional<unsigned> ClockMhz) {
  if (!A.isWanted())
    return std::optional<EnergyRequest>();
  EnergyRequest R{isasim::defaultTechnology(), A.Volts, {}};
  if (!A.Technology.empty()) {
    auto Read = isasim::readTechnology(A.Technology);
    if (!Read)
      return Read.error();
    R.From = std::move(*Read);
  }
  // A clock that is not known yet: any has a voltage that fits.
  if (const auto Fits =
          isasim::EnergyModel::create(R.From, ClockMhz.value_or(1), R.Volts);
      !Fits)
    return Fits.error();
  if (A.GivenChip) {
    auto Given = isasim::samplesGivenChip(R.From);
    if (!Given)
      return Given.error();
    R.Chip = std::move(*Given);
  }
  return std::optional(std::move(R));
}

void checkEnergyOf(Device &D, const std::optional<EnergyRequest> &Energy) {
  if (Energy)
    D.setTimeCheck([Request = *Energy](const TimeReport &T) {
      return checkEnergy(T, Request);
    });
}

} // namespace vorion::splat
