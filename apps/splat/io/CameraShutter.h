/// The rolling shutter of a camera as cameras.json has it.
#pragma once

#include "io/CameraLens.h"

#include <array>

namespace vorion::splat {

/// Start, across and down of a rolling shutter, as a list of three numbers that
/// are at most MostShutterMoment; nothing of anything else.
std::optional<std::array<double, 3>> shutterMoments(const nlohmann::json &J);

/// Reads \p C's shutter; what is wrong, if something is: `rolling_shutter` as
/// three numbers (start, across, down) or one of gsplat's names,
/// `rolling_motion` and `rolling_turn`. A shutter without a motion is none.
std::optional<std::string> readShutter(const KeyFinder &Find, Camera &C);

} // namespace vorion::splat
