/// The states of training of a workload.
#pragma once

#include "commands/WorkloadParts.h"
#include "train/run/Training.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// A state of training as a workload says it.
struct GivenState {
  TrainRequest Request; ///< with the iterations that are timed
  /// What says the same to `splat train`, but for iterations and the pictures'
  /// size.
  std::vector<std::string> Words;
  std::string Options;    ///< those that name no file
  bool HasDegree = false; ///< else it is that of the checkpoint
};

/// Adds a state.
Expected<Success> addState(GivenWorkload &To, const PartHead &Head,
                           GivenState State);

} // namespace vorion::splat
