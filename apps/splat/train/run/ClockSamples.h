/// Selection of the timed iterations of a run, and their simulated times.
#pragma once

#include "device/Launcher.h"
#include "render/FrameEnergy.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <utility>
#include <vector>

namespace vorion::splat {

/// Whether \p Iteration, from 1, is the timed iteration of its block of \p
/// Every. It is selected at random by a counter-based generator with \p Seed,
/// so that periodic work, such as every hundredth iteration, is sampled in
/// proportion.
bool isTimed(uint64_t Seed, unsigned Every, unsigned Iteration);

struct TimedIteration {
  unsigned Number = 0;               ///< from 1
  uint32_t Gaussians = 0;            ///< after it
  std::vector<uint32_t> ListLengths; ///< pairs of the last view's tiles
  std::vector<StageReport> Stages;   ///< of the iteration, with time
};

/// The timed iterations of a run.
class ClockSamples {
public:
  /// Returns false, and adds nothing, if the device reported no time.
  [[nodiscard]] bool add(TimedIteration T);

  /// Numbers of the timed iterations and their times, ms.
  std::vector<std::pair<unsigned, double>> milliseconds() const;

  bool empty() const { return Milliseconds.empty(); }
  /// Iterations per second, from the mean time.
  double rate() const;
  /// One line: mean, standard deviation, minimum and maximum.
  std::string text() const;
  /// The machine and clock of the times.
  std::string machine() const;
  /// Precondition: not empty.
  const TimedIteration &last() const { return All.back(); }
  /// The last iteration by stage (FrameTime.h).
  std::string lastByStage() const;
  /// JSON array with an element for each iteration: number, Gaussians, list
  /// lengths, stages with kernels and counters, time, and energy if requested.
  /// Errors are those of the energy model.
  Expected<nlohmann::ordered_json>
  json(const std::optional<EnergyRequest> &Energy) const;

private:
  std::vector<TimedIteration> All;
  std::vector<double> Milliseconds;
};

} // namespace vorion::splat
