/// `splat accuracy --train`.
#pragma once

#include "accuracy/TrainSweep.h"

#include <CLI/CLI.hpp>
#include <vector>

namespace vorion::splat {

/// Declares --train, which excludes \p OfScenes, and the options that need it.
/// \p P must outlive the parsing.
void addTrainOptions(CLI::App &App, TrainSweepPlan &P,
                     const std::vector<CLI::Option *> &OfScenes);

/// Runs the study \p P with the options \p O, writes its points to
/// training.json and a page, and prints a table.
Expected<Success> measureTraining(TrainSweepPlan P, const StudyOptions &O);

} // namespace vorion::splat
