/// A camera that moves while it exposes its picture row by row
/// (docs/cameras.md, "Rolling shutters").
#pragma once

#include "vorion/support/Expected.h"

#include <array>

namespace vorion::splat {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Pixel (x, y) of a picture W x H is exposed at the time Start + Across x / W
/// + Down y / H. At time 1/2 the camera has its pose; from 0 to 1 it is
/// translated by Motion and rotated by Turn, both uniformly.
struct RollingShutter {
  double Start = 0, Across = 0, Down = 1;
  std::array<double, 3> Motion{}; ///< world units, in the coordinates of the
                                  ///< pose
  std::array<double, 3> Turn{};   ///< axis times angle, in the coordinates of
                                  ///< the pose

  bool operator==(const RollingShutter &) const = default;
};

/// Largest angle of Turn, radians, and largest Start, Across and Down.
inline constexpr double MostShutterTurn = 1.5707963267948966;
inline constexpr double MostShutterMoment = 10;

/// Columns are the camera's axes in the world.
struct CameraPlace {
  std::array<double, 3> Position{};
  Matrix3 Rotation{};
};

/// A camera that moves from one pose to another.
struct CameraWay {
  CameraPlace Middle;
  RollingShutter Shutter; ///< only Motion and Turn
};
/// An Error without location if the rotation exceeds MostShutterTurn.
Expected<CameraWay> wayBetween(const CameraPlace &From, const CameraPlace &To);

/// The pose at \p Moment of a camera with \p Shutter whose pose at time 1/2 is
/// \p Middle.
CameraPlace placeAt(const CameraPlace &Middle, const RollingShutter &Shutter,
                    double Moment);

} // namespace vorion::splat
