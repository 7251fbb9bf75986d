/// The measurement of a task on a machine: one run of `splat render` or `splat
/// train`.
#pragma once

#include "device/DeviceOptions.h"
#include "explore/Workload.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// A machine of a run.
struct TriedMachine {
  std::string Name;                   ///< "base", or its changes
  std::string Settings;               ///< in the syntax of --set
  std::vector<std::string> Arguments; ///< additional arguments
};

/// The common parameters of all runs.
struct RunSetup {
  DeviceOptions Base;
  std::string Technology;      ///< a file; empty for the default
  std::optional<double> Volts; ///< voltage of all machines
};

/// \p Base with \p Settings in the syntax of --set.
DeviceOptions changed(DeviceOptions Base, const std::string &Settings);

/// Runs the task \p What of the part \p Of on \p M. \p Files is the prefix of
/// the run's files. A machine that the simulator rejects is a measurement, too,
/// with the message; if it is the base, it is an Error.
Expected<nlohmann::ordered_json> measureTask(const RunSetup &Setup,
                                             const Part &Of, const Task &What,
                                             const TriedMachine &M,
                                             const std::string &Files);

/// Whether \p J is a result of measureTask().
bool isMeasurement(const nlohmann::ordered_json &J);

/// The key of a measurement's time: "frame_ms".
const char *timeKey(Work W);

/// A one-line summary of a measurement.
std::string described(const nlohmann::ordered_json &Measured);

} // namespace vorion::splat
