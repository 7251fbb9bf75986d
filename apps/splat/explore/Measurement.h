/// A machine at a task: one run of `splat render` or `splat train`.
#pragma once

#include "device/DeviceOptions.h"
#include "explore/Workload.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

namespace vorion::splat {

/// What a machine is, for one run.
struct TriedMachine {
  std::string Name;                   ///< "base", or what differs
  std::string Settings;               ///< as --set takes them
  std::vector<std::string> Arguments; ///< of the run
};

/// What all runs have in common.
struct RunSetup {
  DeviceOptions Base;
  std::string Technology;      ///< a file; empty for the default
  std::optional<double> Volts; ///< of all machines
};

/// \p Base with \p Settings, as --set takes them.
DeviceOptions changed(DeviceOptions Base, const std::string &Settings);

/// Runs \p What of \p Of on \p M. Files of the run have names that begin with
/// \p Files. A machine that cannot be, by the simulator's words, is a
/// measurement, too; that the base cannot is an Error.
Expected<nlohmann::ordered_json> measureTask(const RunSetup &Setup,
                                             const Part &Of, const Task &What,
                                             const TriedMachine &M,
                                             const std::string &Files);

/// Whether \p J has what measureTask() gives.
bool isMeasurement(const nlohmann::ordered_json &J);

/// What a measurement's time is called: "frame_ms".
const char *timeKey(Work W);

/// A measurement in a line.
std::string described(const nlohmann::ordered_json &Measured);

} // namespace vorion::splat
