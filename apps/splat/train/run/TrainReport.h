/// What a training run did, for programs.
#pragma once

#include "train/run/Training.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// Inputs, settings, device, scores, losses and the timed iterations, with
/// energy where it is asked for.
Expected<nlohmann::ordered_json>
trainReport(const TrainRequest &R, const TrainOutcome &Out,
            const std::optional<EnergyRequest> &Energy);

} // namespace vorion::splat
