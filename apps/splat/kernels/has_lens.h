// Whether the camera is no pinhole, or a Gaussian goes through it as points:
// then a file lens_*.cl is part of the program.
#pragma once

#define HAS_LENS                                                               \
  (USE_OPENCV || USE_FISHEYE || USE_ORTHOGRAPHIC || USE_EQUIRECTANGULAR ||     \
   USE_UNSCENTED || USE_ROLLING_SHUTTER)
