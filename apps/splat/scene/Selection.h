/// Sets of the Gaussians of a scene, for `splat convert` and the viewer.
#pragma once

#include "scene/Scene.h"

#include <array>
#include <vector>

namespace vorion::splat {

/// For each Gaussian, whether it is selected.
using Selection = std::vector<bool>;

/// Those whose centre is in the box between the corners (x0, y0, z0) and (x1,
/// y1, z1), which belong to it.
Selection inBox(const Scene &S, const std::array<double, 6> &Corners);

/// Those whose centre is at most the fourth number from the point of the first
/// three.
Selection inSphere(const Scene &S, const std::array<double, 4> &Sphere);

/// Those with an opacity below \p Opacity, 0 to 1.
Selection fainterThan(const Scene &S, double Opacity);

/// Those whose largest standard deviation is above \p Deviation, in units of
/// the scene.
Selection largerThan(const Scene &S, double Deviation);

} // namespace vorion::splat
