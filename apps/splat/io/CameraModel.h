/// The lens and the shutter of a camera.
#pragma once

#include "io/RollingShutter.h"
#include "lens/Lenses.h"

#include <optional>

namespace vorion::splat {

struct CameraModel {
  const LensModel *Model = &lenses::Pinhole;
  /// In the order of the model's record; the rest is 0.
  LensCoefficients K{};
  /// Where the camera moves meanwhile.
  std::optional<RollingShutter> Shutter = std::nullopt;

  bool isPinhole() const { return Model->isPinhole(); }
  /// Where the lens shows what a pinhole shows at (\p X, \p Y). Of what is in
  /// front of the camera.
  LensPlace distorted(double X, double Y) const {
    return Model->Distorted(*Model, K, X, Y);
  }
  /// Up to where \c distorted() is one to one: a radius before distortion.
  double reach() const { return Model->Reach(limit()); }
  /// Up to where the model is one to one.
  double limit() const { return Model->Limit(K); }
  /// The radius before distortion that the radial part takes to \p Distorted:
  /// at most \c limit() and 1000.
  double undistorted(double Distorted) const {
    return undistortedRadius(*Model, K, Distorted);
  }
  /// The direction whose place is (\p X, \p Y); nothing if the lens shows
  /// nothing there.
  std::optional<Direction> direction(double X, double Y) const {
    return Model->Ray(K, X, Y);
  }

  bool operator==(const CameraModel &) const = default;
};

/// A distortion that bends nothing is a pinhole.
CameraModel simplified(const CameraModel &M);

} // namespace vorion::splat
