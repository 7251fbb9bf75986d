/// A camera in the form that the kernels read.
#pragma once

#include "io/Cameras.h"
#include "picture/Layout.h"
#include "picture/Options.h"

#include <vector>

namespace vorion::splat {

/// \p C rounded to fp32 once, with the Jacobian's limits of \p Options' rules
/// and the tiles of its path.
splat_view makeView(const Camera &C, const RenderOptions &Options);

/// What lies behind the view in a program for a camera that is no pinhole.
splat_lens makeLens(const Camera &C);

/// What lies behind that in a program for cameras that move while they expose.
splat_shutter makeShutter(const Camera &C);

/// Whether the rays of \p C, of one moment, are affine in the pixel: those of a
/// pinhole, or parallel.
bool hasAffineRays(const Camera &C);
/// The rays of such a camera.
splat_ray_source makeRays(const Camera &C);
/// The rays of all pixels of a \p C of one moment whose rays are not parallel,
/// from depth \p Nearest on, as RAY_PLANES planes. A pixel outside the image of
/// the lens has a ray without a length.
std::vector<float> makeRayTable(const Camera &C, float Nearest);
/// An upper bound of what rounding takes away from their origins.
float rayOriginRounding(const Camera &C);

/// Whether the principal point is outside the picture, which is then a crop of
/// a larger one: the place's offset cancels against the principal point.
bool isCrop(const splat_view &V);

/// From what places in a picture are measured where fp32 has too few digits for
/// them, which is not that of a full sphere.
splat_crop makeCrop(const Camera &C);

/// Likewise in the windows of a picture, whose sides are 2^\p Bits px: row by
/// row, each with places from its first pixel.
std::vector<splat_crop> makeWindows(const Camera &C, unsigned Bits);

/// The model by which one program draws all of \p Cameras, \p Path's: the one
/// that they have, or a distortion for pinholes among such.
Expected<const LensModel *> commonModel(const std::string &Path,
                                        const std::vector<Camera> &Cameras);

/// Whether one of \p Cameras moves while it exposes.
bool isRolling(const std::vector<Camera> &Cameras);

/// Sets the lens and the shutter that \p O draws through: those of \p Cameras,
/// which \p Path has. An error if they have no common model.
Expected<Success> drawThrough(RenderOptions &O, const std::string &Path,
                              const std::vector<Camera> &Cameras);

/// Whether a program for cameras of model \p Program draws \p C.
bool isDrawnBy(const LensModel &Program, const Camera &C);

} // namespace vorion::splat
