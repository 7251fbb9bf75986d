/// The lens of a camera as JSON has it: in cameras.json, in transforms.json and
/// in what gsplat and nerfstudio write.
#pragma once

#include "io/Cameras.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>

namespace vorion::splat {

/// Finds the value of a key, or null.
using KeyFinder = std::function<const nlohmann::json *(const char *Key)>;

/// Reads \p C's lens; what is wrong, if something is. Names of models are those
/// of \c lensModelNamed, under the keys camera_model, model, camera_type,
/// projection, projection_type, or is_fisheye; coefficients k1 to k6, p1, p2,
/// s1 to s4, or OpenCV's dist_coeffs, or gsplat's radial_coeffs,
/// tangential_coeffs and thin_prism_coeffs. Without a model's name they are
/// OPENCV's. A lens without an effect is a pinhole. Where it is
/// equirectangular, focal lengths and principal point are set from the size.
std::optional<std::string> readLens(const KeyFinder &Find, Camera &C);

/// \p M as readLens() reads it: its name and its coefficients; null for a
/// pinhole.
nlohmann::json lensJson(const CameraModel &M);

/// Gives the equirectangular \p C, whose size is there, its focal lengths and
/// principal point: it sees the full sphere.
void setSphere(Camera &C);

} // namespace vorion::splat
