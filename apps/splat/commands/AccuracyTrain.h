/// `splat accuracy --train`.
#pragma once

#include "accuracy/TrainSweep.h"

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Declares --train, which excludes \p OfScenes, and what needs it; \p P must
/// outlive the parsing.
void addTrainOptions(CLI::App &App, TrainSweepPlan &P,
                     const std::vector<CLI::Option *> &OfScenes);

/// Measures the points that are missing, writes all of them to training.json
/// and a page, and prints a table; with \p List prints their names alone, with
/// \p Only measures those alone.
Expected<Success>
measureTraining(TrainSweepPlan P, bool List,
                const std::vector<std::string> &Only,
                const std::function<void(std::string_view)> &Log);

} // namespace vorion::splat
