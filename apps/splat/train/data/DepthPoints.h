/// How deep a capture's points are in a training picture.
#pragma once

#include "capture/Capture.h"
#include "render/DepthTargets.h"

#include <vector>

namespace vorion::splat {

/// Those of \p Points numbered \p Sees, in the pixels where \p Pose, a pinhole,
/// shows them, by pixel and then by depth. Left out is what is behind the
/// camera or beside the picture, and where \p Counts, if it is not empty, has a
/// 0.
std::vector<DepthPoint> depthPoints(const Camera &Pose,
                                    const CapturePoints &Points,
                                    const std::vector<uint32_t> &Sees,
                                    const std::vector<uint8_t> &Counts);

} // namespace vorion::splat
