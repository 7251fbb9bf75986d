/// `splat accuracy --train`.
#pragma once

#include "accuracy/TrainSweep.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace vorion::splat {

/// Declares --train, which excludes \p OfScenes, and what needs it; \p P must
/// outlive the parsing.
void addTrainOptions(CLI::App &App, TrainSweepPlan &P,
                     const std::vector<CLI::Option *> &OfScenes);

/// Measures the points of \p P as \p O says, writes all of them to
/// training.json and a page, and prints a table.
Expected<Success> measureTraining(TrainSweepPlan P, const StudyOptions &O);

} // namespace vorion::splat
