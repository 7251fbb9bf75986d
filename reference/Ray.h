/// The way back through a camera: from a place on the picture to what is seen
/// there. The judge of footprints needs it (AlongRays.h).
#pragma once

#include "Lens.h"

#include <optional>

namespace vorion::reference {

/// What \p C sees at a place on its picture, at the moment at which it exposes
/// that place. All in the axes of the camera's pose.
struct PixelRay {
  glm::dvec3 Eye;       ///< where the camera is then
  glm::dvec3 Origin;    ///< where the ray begins: not the eye of parallel rays
  glm::dvec3 Direction; ///< of unit length
  glm::dvec3 Ahead;     ///< the camera's axis then
  /// Of the place in pixels by the point, at depth 1 on the ray. Farther away
  /// they are shorter, but those of parallel rays are not.
  LensRows<double> Rows;
};

/// That of the place \p At, px; nothing where the lens shows nothing.
std::optional<PixelRay> rayAt(const Camera<double> &C, const glm::dvec2 &At);

} // namespace vorion::reference
