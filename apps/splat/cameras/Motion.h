/// Cameras derived from others: orbits, paths, other picture sizes.
#pragma once

#include "io/Cameras.h"
#include "io/Vector.h"

#include <optional>
#include <vector>

namespace vorion::splat {

/// The common up direction of \p Cameras: orthogonal to the right axes of all
/// cameras if they are level, otherwise the mean of their up axes; empty if
/// there is none.
std::optional<Vector> upOf(const std::vector<Camera> &Cameras);

/// The point nearest to the optical axes of \p Cameras, by least squares; empty
/// if there is one camera, if their directions are nearly the same, or if the
/// point is behind most of them.
std::optional<Vector> lookedAt(const std::vector<Camera> &Cameras);

/// \p Count cameras on a full circle: \p Start, rotated about the axis \p Up (a
/// unit vector) through \p Centre. The first camera is \p Start itself. Names
/// are orbit-0 and so on, padded with zeros to the same length.
std::vector<Camera> orbit(const Camera &Start, const Vector &Centre,
                          const Vector &Up, int Count);

/// \p Count cameras along a smooth path through at least two \p Keys, with the
/// same number of pictures between any two keys. Positions follow a Catmull-Rom
/// spline, rotations the same spline of quaternions. Picture sizes are those of
/// the first key. Names are path-0 and so on.
std::vector<Camera> alongPath(const std::vector<Camera> &Keys, int Count);

/// \p C with another picture size and the same horizontal field of view; the
/// centre of the picture does not change.
Camera resized(Camera C, int Width, int Height);

/// The same in the aspect ratio of \p C.
Camera resized(Camera C, int Width);

} // namespace vorion::splat
