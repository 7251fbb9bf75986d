/// What `splat explore` refuses of a space before it measures anything.
#pragma once

#include "device/DeviceOptions.h"
#include "explore/Space.h"
#include "explore/Workload.h"

#include <set>
#include <string>

namespace vorion::splat {

/// The options that say how work of the kind \p W is computed.
std::set<std::string> computingOptions(Work W);

/// That \p Base opens with each value of \p S alone, and that the options are
/// of how what \p Does has is computed, with values that they take. \p Where
/// has the space. This process must have no device yet.
Expected<Success> checkSpace(const Space &S, const Workload &Does,
                             const DeviceOptions &Base,
                             const std::string &Where);

} // namespace vorion::splat
