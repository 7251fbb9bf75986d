/// What a frame costs on the machine in joules, by stage, kernel and unit
/// (docs/energy.md), from its time reports.
#pragma once

#include "render/Renderer.h"
#include "vorion/isasim/Energy.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// That energies are wanted, and by which numbers.
struct EnergyRequest {
  isasim::Technology From;
  std::optional<double> Volts; ///< by the technology's law, if not given
};

/// Whether \p Request can say how much energy a run with the report \p T took:
/// whether it knows the machine's clock and DRAM.
Expected<Success> checkEnergy(const TimeReport &T,
                              const EnergyRequest &Request);

/// JSON of the frame: joules a unit, a stage and a kernel, and the machine's
/// area. Null without the clock. The errors are the model's.
Expected<nlohmann::ordered_json>
frameEnergyJson(const std::vector<StageReport> &Stages,
                const EnergyRequest &Request);
/// The same as tables, in which \p What stands for a frame; empty without the
/// clock.
Expected<std::string> frameEnergyText(const std::vector<StageReport> &Stages,
                                      const EnergyRequest &Request,
                                      const std::string &What = "frame");

} // namespace vorion::splat
