// The camera's model: the one place of the kernels that chooses it. Its file,
// lens_*.cl, has
//
//     lens_at         the place of a point in the camera's axes, in units of the
//                     focal lengths; false where the camera does not see it
//     lens_jacobian   the rows of the Jacobian of that, where the model holds it
//                     if `hold`
//     lens_curvature  dL/d(point) from dL/d(rows)
//     lens_is_held    whether it does so, if `hold`
//     LENS_HOLDS      whether projecting holds it
//     crop_mean       the place in pixels of a point that is so far beside a ray
//                     (crop.cl), from differences to the ray's own place alone
//
// and says by macros what else depends on it:
//
//     LENS_BY_DISTANCE  depth is the distance from the camera, not z
//     LENS_IS_PARALLEL  its rays are parallel
//     LENS_CLOSES       the picture's left and right sides are one line: what
//                       crosses them is drawn on both
//     LENS_IS_PINHOLE   a program may do without splat_lens
#pragma once

// The lens is OpenCV's (lens/OpenCv.cpp).
#pragma vorion choice effect USE_OPENCV
// The lens divides (lens/Division.cpp).
#pragma vorion choice effect USE_DIVISION
// The lens divides by a root plus the depth (lens/Eucm.cpp).
#pragma vorion choice effect USE_EUCM
// The lens is a fisheye (lens/Fisheye.cpp).
#pragma vorion choice effect USE_FISHEYE
// Rays are parallel (lens/Orthographic.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC
// The picture is the whole sphere (lens/Equirectangular.cpp).
#pragma vorion choice effect USE_EQUIRECTANGULAR
// Gaussians go through the lens as points (effects/Unscented.cpp).
#pragma vorion choice effect USE_UNSCENTED
// The camera moves while it exposes (effects/RollingShutter.cpp).
#pragma vorion choice effect USE_ROLLING_SHUTTER

#if USE_OPENCV
#include "lens_opencv.cl"
#elif USE_DIVISION
#include "lens_division.cl"
#elif USE_EUCM
#include "lens_eucm.cl"
#elif USE_FISHEYE
#include "lens_fisheye.cl"
#elif USE_ORTHOGRAPHIC
#include "lens_orthographic.cl"
#elif USE_EQUIRECTANGULAR
#include "lens_equirectangular.cl"
#else
#include "lens_pinhole.cl"
#endif

// Whether the camera is no pinhole, or a Gaussian goes through it as points:
// then splat_lens lies behind the view.
#define HAS_LENS                                                               \
  (!LENS_IS_PINHOLE || USE_UNSCENTED || USE_ROLLING_SHUTTER)
