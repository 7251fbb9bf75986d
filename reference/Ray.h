/// Unprojection: from a position on the picture to its ray. Needed by the
/// reference for footprints (AlongRays.h).
#pragma once

#include "Lens.h"

#include <optional>

namespace vorion::reference {

/// The ray of a position on the picture, at the time at which the camera
/// exposes that position. In the axes of the camera's pose.
struct PixelRay {
  glm::dvec3 Eye;       ///< where the camera is then
  glm::dvec3 Origin;    ///< where the ray begins: not the eye of parallel rays
  glm::dvec3 Direction; ///< of unit length
  glm::dvec3 Ahead;     ///< the camera's axis then
  /// Of the place in pixels by the point, at depth 1 on the ray. Farther away
  /// they are shorter, but those of parallel rays are not.
  LensRows<double> Rows;
};

/// The ray of the position \p At, px; empty outside the image of the lens.
std::optional<PixelRay> rayAt(const Camera<double> &C, const glm::dvec2 &At);

} // namespace vorion::reference
