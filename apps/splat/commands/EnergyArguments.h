/// What subcommands that say how long something takes also take, to say how
/// much energy.
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

  /// Naming a technology or a voltage asks, too.
  bool isWanted() const {
    return Energy || !Technology.empty() || Volts.has_value();
  }
};

/// Declares --energy, --technology and --voltage; \p A must outlive the
/// parsing. \p What is what takes the energy.
void addEnergyOptions(CLI::App &App, EnergyArguments &A,
                      const std::string &What);

/// Reads the technology. Nothing if energies are not wanted; an error if the
/// file is none, or has no voltage for the clock.
Expected<std::optional<EnergyRequest>>
requestedEnergy(const EnergyArguments &A, std::optional<unsigned> ClockMhz);

/// Has \p D end a run with its first kernel where \p Energy cannot say how much
/// it takes, rather than after the last.
void checkEnergyOf(Device &D, const std::optional<EnergyRequest> &Energy);

} // namespace vorion::splat
