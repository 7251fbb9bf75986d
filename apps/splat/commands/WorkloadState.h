/// Training states of a workload.
#pragma once

#include "commands/WorkloadParts.h"
#include "train/run/Training.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// A training state of a workload.
struct GivenState {
  TrainRequest Request; ///< with the number of timed iterations
  /// The equivalent arguments of `splat train`, except iterations and
  /// downsampling.
  std::vector<std::string> Words;
  std::string Options;    ///< options that do not name files
  bool HasDegree = false; ///< otherwise the degree is that of the checkpoint
};

/// Adds a training state.
Expected<Success> addState(GivenWorkload &To, const PartHead &Head,
                           GivenState State);

} // namespace vorion::splat
