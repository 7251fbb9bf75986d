/// Pictures by evaluation along rays, a reference for projected footprints, and
/// their gradients.
#pragma once

#include "Backward.h"

namespace vorion::reference {

/// Depths that define a pixel's blend order.
enum class RayDepths {
  Own,  ///< those of the camera where it is when it exposes the pixel
  Pose, ///< those of the camera's pose, as footprints have them
  Ray   ///< of each Gaussian where it is densest on the ray, as traced rays
        ///< have them; these are culled by the near plane
};

/// Renders a picture in which each Gaussian is evaluated at its maximum density
/// along a pixel's ray (as in the rasterizers of 3DGUT and gsplat), from the
/// camera's position when it exposes the pixel. The camera at this time
/// determines near-plane culling, the order of blending by \p By, and colours.
/// The dilation, which \c RayDepths::Ray must not have, is added perpendicular
/// to the ray, at the mean's depth. A
/// Gaussian whose maximum is behind the ray's origin is culled; parallel rays
/// have no origin.
///
/// The support of a Gaussian is unlimited, so \c Options::Reach and \c Through
/// are ignored. A pixel is doubtful where an alpha or a transmittance is within
/// \c DoubtBand of its threshold, a Gaussian is densest at the origin, the
/// cosine being within that of 0, or fp32 may have two depths in another order;
/// two depths along a ray may differ by \c DoubtBand.
/// \c Walked counts the Gaussians that each pixel evaluates completely.
Picture<double> renderAlongRays(const Gaussians<double> &G,
                                const Camera<double> &C, const Options &O,
                                RayDepths By = RayDepths::Own);

/// Gradients of a loss through such a picture, without dilation. \c Means2d is
/// dL/d(mean) for a step across the picture, in pixels, at the mean's depth; of
/// \c Sums there are Color and S only, and no \c Conics. A Gaussian may have
/// scales of 0.
Gradients alongRaysBackward(const Gaussians<double> &G, const Camera<double> &C,
                            const Upstream &U, const Options &O);

} // namespace vorion::reference
