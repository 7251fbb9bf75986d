/// The JSON report of a training run.
#pragma once

#include "train/run/Training.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// Inputs, settings, device, scores, losses and timed iterations, with energy
/// if requested.
Expected<nlohmann::ordered_json>
trainReport(const TrainRequest &R, const TrainOutcome &Out,
            const std::optional<EnergyRequest> &Energy);

} // namespace vorion::splat
