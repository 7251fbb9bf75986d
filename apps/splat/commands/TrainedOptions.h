/// The options of `splat train` that say what is trained and how it is
/// computed: all but where a run is kept and what is told of it.
#pragma once

#include "commands/TrainSettingOptions.h"
#include "train/run/Training.h"

#include <CLI/CLI.hpp>

namespace vorion::splat {

struct TrainedArguments {
  TrainRequest Request;
  SettingOptions Settings;
};

/// Declares the capture, its pictures, where a run begins, its settings and
/// rules. \p A must outlive the parsing, here and below.
void addTrainedOptions(CLI::App &App, TrainedArguments &A);

/// Declares what computes an iteration: the path, and its units and sums.
void addTrainPathOptions(CLI::App &App, TrainRequest &R);

/// Completes \p A, which \p App has parsed, with what follows from its options.
Expected<Success> completeTrained(const CLI::App &App, TrainedArguments &A);

/// Whether the values of these options go together; an error is one of usage.
Expected<Success> checkTrained(const TrainRequest &R);

} // namespace vorion::splat
