/// Cameras made from others: around something, along a path, in another size.
#pragma once

#include "cameras/Vector.h"
#include "io/Cameras.h"

#include <optional>
#include <vector>

namespace vorion::splat {

/// The direction that \p Cameras have above them: that to which the right of
/// each is at a right angle if they are level, else the mean of their own ups;
/// nothing if they have none in common.
std::optional<Vector> upOf(const std::vector<Camera> &Cameras);

/// The point nearest to the optical axes of \p Cameras, by squares of
/// distances; nothing if there is one camera, if they look in nearly the same
/// direction, or if most have it behind them.
std::optional<Vector> lookedAt(const std::vector<Camera> &Cameras);

/// \p Count cameras that are \p Start turned about the axis \p Up (a unit
/// vector) through \p Centre, once around; the first is \p Start itself. Their
/// names are orbit-0 and so on, with as many digits as the last needs.
std::vector<Camera> orbit(const Camera &Start, const Vector &Centre,
                          const Vector &Up, int Count);

/// \p Count cameras along a smooth path through \p Keys, of which there are at
/// least two: from the first to the last, as many pictures from each key to the
/// next. Positions follow Catmull and Rom's curve, rotations the same of
/// quaternions. Sizes are the first key's. Names are path-0 and so on.
std::vector<Camera> alongPath(const std::vector<Camera> &Keys, int Count);

/// \p C with another size of picture and the same horizontal field of view;
/// what was in the picture's middle stays there.
Camera resized(Camera C, int Width, int Height);

} // namespace vorion::splat
