/// The energy of a frame on the machine, by stage, kernel and unit
/// (docs/energy.md), computed from its time reports.
#pragma once

#include "render/Renderer.h"
#include "vorion/isasim/Energy.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A request for energies: the technology and voltage.
struct EnergyRequest {
  isasim::Technology From;
  std::optional<double> Volts; ///< default: by the technology's law
  /// Also given the area and the power of the technology's chip.
  std::optional<isasim::ChipSamples> Chip;
};

/// Checks that \p Request defines the clock and DRAM of the machine of \p T,
/// which its energy needs.
Expected<Success> checkEnergy(const TimeReport &T,
                              const EnergyRequest &Request);

/// JSON of the frame: joules of each unit, stage and kernel, and the machine's
/// area, also given a chip. Null without the clock. Errors: the energy model's.
Expected<nlohmann::ordered_json>
frameEnergyJson(const std::vector<StageReport> &Stages,
                const EnergyRequest &Request);
/// The same as tables, with \p What in place of "frame"; empty without the
/// clock.
Expected<std::string> frameEnergyText(const std::vector<StageReport> &Stages,
                                      const EnergyRequest &Request,
                                      const std::string &What = "frame");

} // namespace vorion::splat
