/// The rolling shutter of a camera as cameras.json has it.
#pragma once

#include "io/CameraLens.h"

namespace vorion::splat {

/// Reads \p C's shutter; what is wrong, if something is: `rolling_shutter` as
/// three numbers (start, across, down) or one of gsplat's names,
/// `rolling_motion` and `rolling_turn`. A shutter without a motion is none.
std::optional<std::string> readShutter(const KeyFinder &Find, Camera &C);

} // namespace vorion::splat
