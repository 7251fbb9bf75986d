/// Which iterations of a run the machine's clock times, and how long they took.
#pragma once

#include "device/Launcher.h"
#include "render/FrameEnergy.h"

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// Whether iteration \p Iteration, from 1, is the one of its \p Every that is
/// timed. Drawn by counting random numbers from \p Seed: what is done every
/// hundredth iteration is timed as often as it comes.
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
  /// False, and nothing is added, if the device gave no time.
  [[nodiscard]] bool add(TimedIteration T);

  bool empty() const { return Milliseconds.empty(); }
  /// Iterations a second, by the mean.
  double rate() const;
  /// A line: mean, standard deviation, least and most.
  std::string text() const;
  /// The machine and the clock that the times are of.
  std::string machine() const;
  /// Where there is one.
  const TimedIteration &last() const { return All.back(); }
  /// The last one by stage (FrameTime.h).
  std::string lastByStage() const;
  /// JSON array, an iteration each: number, Gaussians, list lengths, stages
  /// with kernels and counters, time, and energy where it is asked for. The
  /// errors are the model's.
  Expected<nlohmann::ordered_json>
  json(const std::optional<EnergyRequest> &Energy) const;

private:
  std::vector<TimedIteration> All;
  std::vector<double> Milliseconds;
};

} // namespace vorion::splat
