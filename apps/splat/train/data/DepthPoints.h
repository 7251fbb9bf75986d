/// Depths of a capture's points in a training picture.
#pragma once

#include "capture/Capture.h"
#include "render/DepthTargets.h"

#include <vector>

namespace vorion::splat {

/// The depths of the \p Points, 3 floats each, with indices \p Sees in the
/// picture of \p Pose, a pinhole in their frame, sorted by pixel and then by
/// depth. Points behind the camera or outside the picture, and pixels with a 0
/// in \p Counts (if not empty), are skipped.
std::vector<DepthPoint> depthPoints(const Camera &Pose,
                                    const std::vector<float> &Points,
                                    const std::vector<uint32_t> &Sees,
                                    const std::vector<uint8_t> &Counts);

} // namespace vorion::splat
