/// Simulation times on the host, and the accuracy of the resulting cycles.
#pragma once

#include "accuracy/Sweep.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// The results of a simulation method.
struct HostTime {
  std::string Simulation;
  /// Processor seconds of each run, in ascending order.
  std::vector<double> Seconds;
  bool Extrapolated = false; ///< whether seconds are extrapolated from a part
                             ///< of the work
  /// Error of its cycles compared with the clock, or for the RTL, error of the
  /// clock compared with the RTL, in percent.
  std::optional<double> ErrorPercent;
  std::string Note;
};

/// Measures functional, sampled and clocked simulation of \p Views with the
/// default setting, each in separate processes, and the rasterizer in
/// SystemVerilog on random tiles of the first view. A method that cannot run
/// has no seconds, and the reason in its note. \p Log is called at the start of
/// each measurement.
Expected<std::vector<HostTime>>
measureHostTime(const SweepPlan &P, const std::vector<Camera> &Views,
                const std::function<void(std::string_view)> &Log);

/// For the terminal.
std::string hostTimeText(const std::vector<HostTime> &All,
                         const std::vector<Camera> &Views);
nlohmann::ordered_json hostTimeJson(const std::vector<HostTime> &All);

} // namespace vorion::splat
