// Whether the camera is no pinhole, or a Gaussian goes through it as points:
// then a file lens_*.cl is part of the program.
#pragma once

// The lens is OpenCV's (effects/OpenCvLens.cpp).
#pragma vorion choice effect USE_OPENCV
// The lens is a fisheye (effects/FisheyeLens.cpp).
#pragma vorion choice effect USE_FISHEYE
// Rays are parallel (effects/OrthographicLens.cpp).
#pragma vorion choice effect USE_ORTHOGRAPHIC
// The picture is the whole sphere (effects/EquirectangularLens.cpp).
#pragma vorion choice effect USE_EQUIRECTANGULAR
// Gaussians go through the lens as points (effects/Unscented.cpp).
#pragma vorion choice effect USE_UNSCENTED
// The camera moves while it exposes (effects/RollingShutter.cpp).
#pragma vorion choice effect USE_ROLLING_SHUTTER

#define HAS_LENS                                                               \
  (USE_OPENCV || USE_FISHEYE || USE_ORTHOGRAPHIC || USE_EQUIRECTANGULAR ||     \
   USE_UNSCENTED || USE_ROLLING_SHUTTER)
