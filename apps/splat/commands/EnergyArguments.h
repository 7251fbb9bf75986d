/// Energy options of the subcommands that report simulated time.
#pragma once

#include "render/FrameEnergy.h"

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

struct EnergyArguments {
  bool Energy = false;
  std::string Technology; ///< a file; empty for the default
  std::optional<double> Volts;
  bool GivenChip = false;

  /// Any of the others implies --energy.
  bool isWanted() const {
    return Energy || !Technology.empty() || Volts.has_value() || GivenChip;
  }
};

/// Declares --energy and the options that imply it; \p A must outlive the
/// parsing. \p What names the consumer of the energy in the help.
void addEnergyOptions(CLI::App &App, EnergyArguments &A,
                      const std::string &What);

/// Reads the technology. Empty if energy is not requested. An error if the file
/// is malformed, or has no voltage for the clock.
Expected<std::optional<EnergyRequest>>
requestedEnergy(const EnergyArguments &A, std::optional<unsigned> ClockMhz);

/// Makes a run on \p D fail at its first kernel, instead of after its last, if
/// its energy cannot be computed by \p Energy.
void checkEnergyOf(Device &D, const std::optional<EnergyRequest> &Energy);

} // namespace vorion::splat
