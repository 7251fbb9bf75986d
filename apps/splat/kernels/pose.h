/// What training adds to layout.h where it corrects poses. Compiled as C++ and
/// as OpenCL C.
#pragma once

// NOLINTBEGIN(readability-identifier-naming): OpenCL names, as in layout.h.

enum {
  /// Planes behind GRADIENT_PLANES: what of the mean's gradient came through
  /// the direction from which its colour is seen.
  GRADIENT_DIRECTION = GRADIENT_PLANES,
  POSE_GRADIENT_PLANES = GRADIENT_DIRECTION + 3,
  POSE_TERMS = 6 ///< of pose_back: force x, y, z and torque x, y, z
};

// NOLINTEND(readability-identifier-naming)
