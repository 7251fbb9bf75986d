/// The frame in which a scene is computed.
#pragma once

#include "io/LocalFrame.h"
#include "scene/Scene.h"

#include <vector>

namespace vorion::splat {

/// Means of \p S in the caller's frame, for io/LocalFrame.h.
std::vector<WorldPoint> sampleOf(const Scene &S);

/// Whether fp32 in the caller's frame would move the Gaussians of \p S by more
/// than MostPixelsLost (pixelsLost() without cameras).
bool needsDoubles(const Scene &S);

/// Measures the means of \p S from localOrigin() for pictures of \p Cameras, if
/// its file or its transforms give more digits than fp32 has. Otherwise no bit
/// changes: kernels subtract the camera's position from fp32 means exactly
/// where it matters.
void recentre(Scene &S, const std::vector<Camera> &Cameras);

} // namespace vorion::splat
