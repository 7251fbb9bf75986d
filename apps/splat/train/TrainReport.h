/// What a training run did, for programs.
#pragma once

#include "train/Training.h"

#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// Inputs, settings, device, scores, losses and the timed iterations.
nlohmann::ordered_json trainReport(const TrainRequest &R,
                                   const TrainOutcome &Out);

} // namespace vorion::splat
