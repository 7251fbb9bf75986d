/// Pictures without footprints, which judge those of footprints.
#pragma once

#include "Render.h"

namespace vorion::reference {

/// By which depths a pixel blends what it sees.
enum class RayDepths {
  Own, ///< those of the camera where it is when it exposes the pixel
  Pose ///< those of the camera's pose, as footprints have them
};

/// A picture in which a pixel sees of each Gaussian the largest density on its
/// ray (as 3DGUT's and gsplat's rasterizers do), from where the camera is when
/// it exposes the pixel. The pixel's own camera says which means are in front
/// of the near plane, in which order they are blended by \p By, and their
/// colours. The dilation is added across the ray, at the mean's depth. A
/// Gaussian that is densest behind the ray's origin is not seen.
///
/// No support limits a Gaussian, so \c Options::Reach and \c Through are not
/// read, nor is any pixel doubtful. \c Walked counts what each pixel looks at
/// more closely.
Picture<double> renderAlongRays(const Gaussians<double> &G,
                                const Camera<double> &C, const Options &O,
                                RayDepths By = RayDepths::Own);

} // namespace vorion::reference
