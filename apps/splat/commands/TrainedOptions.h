/// The options of `splat train` that determine the result: all except its
/// outputs and reports.
#pragma once

#include "commands/TrainSettingOptions.h"
#include "train/run/Training.h"

#include <CLI/CLI.hpp>

namespace vorion::splat {

struct TrainedArguments {
  TrainRequest Request;
  SettingOptions Settings;
};

/// Declares the capture, its pictures, the initial scene, settings and rules.
/// \p A must outlive the parsing, here and below.
void addTrainedOptions(CLI::App &App, TrainedArguments &A);

/// Declares the path of an iteration, and its units and sums.
void addTrainPathOptions(CLI::App &App, TrainRequest &R);

/// Sets the members of \p A that follow from the options that \p App has
/// parsed.
Expected<Success> completeTrained(const CLI::App &App, TrainedArguments &A);

/// Checks that the values of these options are consistent; otherwise a usage
/// error.
Expected<Success> checkTrained(const TrainRequest &R);

} // namespace vorion::splat
