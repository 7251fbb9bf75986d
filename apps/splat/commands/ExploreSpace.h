/// What `splat explore` refuses of a space before it measures anything.
#pragma once

#include "device/DeviceOptions.h"
#include "explore/Space.h"

#include <string>

namespace vorion::splat {

/// That \p Base opens with each value of \p S alone, and that the options are
/// of how a picture is computed, with values that they take. \p Where has the
/// space. This process must have no device yet.
Expected<Success> checkSpace(const Space &S, const DeviceOptions &Base,
                             const std::string &Where);

} // namespace vorion::splat
