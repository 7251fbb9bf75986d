/// Cameras that move while they expose (docs/cameras.md, "Rolling shutters").
#pragma once

#include "Lens.h"

#include <glm/mat2x2.hpp>

namespace vorion::reference {

/// \p V turned about \p Turn by its length times \p Part: what the camera of a
/// shutter with that turn has along \p V, \p Part of an exposure after its
/// pose.
glm::dvec3 turned(const glm::dvec3 &Turn, double Part, const glm::dvec3 &V);

/// The moment from the pose's at which \p C exposes the place \p At, px.
double momentAt(const Camera<double> &C, const glm::dvec2 &At);

/// A point as such a camera sees it, at the moment at which the point's own
/// pixel is exposed.
struct ExposedPoint {
  double Moment = 0; ///< from the pose's
  glm::dvec3 P;      ///< to the camera at that moment
  glm::dvec2 Place;  ///< in units of the focal lengths
  /// Of the place in pixels by the point in the axes of the pose. Where the
  /// rules hold the Jacobian, it is held.
  LensRows<double> Rows;
  LensRows<double> Free; ///< the same, held nowhere
  /// Of steps on the picture that a camera sees which stands still at the
  /// moment, to those on this one: rows that are exposed later see the point
  /// moved. Rows are this times the still camera's.
  glm::dmat2 Shear;
  glm::dmat2 FreeShear; ///< of the rows that are held nowhere
};

/// \p P in the axes of the pose of \p C. False if the camera does not see it,
/// or if the picture falls behind its shutter by less than a quarter there.
/// Outside the picture time goes on for one exposure.
template <typename Real>
bool expose(const Camera<Real> &C, const glm::dvec3 &P, Rules Rule,
            ExposedPoint &Found);

/// dL/d(Rows) and dL/d(Shear) of an \c ExposedPoint.
struct ByExposedPoint {
  LensRows<double> Rows;
  glm::dmat2 Shear;
};

/// dL/dP of a point that \p C sees from \p By, of the rows that \p Rule holds,
/// or of those that are held nowhere.
glm::dvec3 backThroughShutter(const Camera<double> &C, const glm::dvec3 &P,
                              std::optional<Rules> Rule,
                              const ByExposedPoint &By);

} // namespace vorion::reference
