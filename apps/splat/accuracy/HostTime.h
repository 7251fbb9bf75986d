/// How long the host takes to say how long the machine takes: what accuracy of
/// cycles costs in seconds of the host.
#pragma once

#include "accuracy/Sweep.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A way to simulate.
struct HostTime {
  std::string Simulation;
  /// Processor seconds of the host, rising: a run each.
  std::vector<double> Seconds;
  bool Extrapolated = false; ///< the seconds, from a part of the work
  /// Of the cycles that it gives, against the clock's or, of the RTL, of the
  /// clock's against it, in percent.
  std::optional<double> ErrorPercent;
  std::string Note;
};

/// Measures on \p Views, with the default setting: functional, sampled and
/// clocked simulation, each by processes of their own, and the rasterizer in
/// SystemVerilog on tiles of the first view that are drawn at random. What is
/// missing for one of these is said in its note, and it has no seconds. \p Log
/// gets a line for each that begins.
Expected<std::vector<HostTime>>
measureHostTime(const SweepPlan &P, const std::vector<Camera> &Views,
                const std::function<void(std::string_view)> &Log);

/// For the terminal.
std::string hostTimeText(const std::vector<HostTime> &All,
                         const std::vector<Camera> &Views);
nlohmann::ordered_json hostTimeJson(const std::vector<HostTime> &All);

} // namespace vorion::splat
