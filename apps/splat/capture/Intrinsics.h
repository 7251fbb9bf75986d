/// Focal lengths and principal points as files of transforms have them.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace vorion::splat {

/// What is known of a camera before its picture's size is.
struct Intrinsics {
  struct Axis {
    std::optional<double> Focal;  ///< pixels
    std::optional<double> Angle;  ///< field of view, radians; without Focal
    std::optional<double> Centre; ///< pixels
  };
  Axis X, Y;
  bool IsSphere = false; ///< sees all around: it has no focal length
};

/// \p Value, which \p Key has. The error's place is empty.
Expected<double> finiteNumber(const nlohmann::json &Value,
                              const std::string &Key);

/// Reads, of each axis, fl_x, or camera_angle_x in radians, or x_fov in
/// degrees, and cx (fl_y and so on). What \p Frame has of an axis goes before
/// what \p Document has. One axis may be without focal length: it has the
/// other's. The error's place is empty.
Expected<Intrinsics> readIntrinsics(const nlohmann::json &Frame,
                                    const nlohmann::json &Document,
                                    bool IsSphere);

/// Completes \p C, whose width and height are there. Principal points that are
/// not known lie in the middle.
void complete(Camera &C, const Intrinsics &I);

} // namespace vorion::splat
