/// Checks of a space by `splat explore` before any measurement.
#pragma once

#include "device/DeviceOptions.h"
#include "explore/Space.h"
#include "explore/Workload.h"

#include <set>
#include <string>

namespace vorion::splat {

/// The options that determine how work of the kind \p W is computed.
std::set<std::string> computingOptions(Work W);

/// Checks that \p Base opens with each single change in \p S, that its options
/// affect work of \p Does, and that their values are valid. \p Where names the
/// space in messages. No device may be open in this process.
Expected<Success> checkSpace(const Space &S, const Workload &Does,
                             const DeviceOptions &Base,
                             const std::string &Where);

} // namespace vorion::splat
