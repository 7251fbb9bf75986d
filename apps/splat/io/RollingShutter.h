/// A camera that moves while it exposes its picture row by row
/// (docs/cameras.md, "Rolling shutters").
#pragma once

#include "vorion/support/Expected.h"

#include <array>

namespace vorion::splat {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// Pixel (x, y) of a picture W x H is exposed at the moment
/// Start + Across x / W + Down y / H. At 1/2 the camera has its pose; between 0
/// and 1 it moves by Motion and turns by Turn, both evenly.
struct RollingShutter {
  double Start = 0, Across = 0, Down = 1;
  std::array<double, 3> Motion{}; ///< world units along the pose's own axes
  std::array<double, 3> Turn{};   ///< axis times angle, by the pose's own axes

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

/// A camera on its way from one place to another.
struct CameraWay {
  CameraPlace Middle;
  RollingShutter Shutter; ///< Motion and Turn alone
};
/// An Error, at no place, where the turn is larger than MostShutterTurn.
Expected<CameraWay> wayBetween(const CameraPlace &From, const CameraPlace &To);

/// Where a camera with \p Shutter, whose pose is \p Middle, is at \p Moment.
CameraPlace placeAt(const CameraPlace &Middle, const RollingShutter &Shutter,
                    double Moment);

} // namespace vorion::splat
