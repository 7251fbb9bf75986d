/// The lens of a camera as JSON has it: in cameras.json, in transforms.json and
/// in what gsplat and nerfstudio write.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <functional>
#include <nlohmann/json_fwd.hpp>

namespace vorion::splat {

/// Finds the value of a key, or null.
using KeyFinder = std::function<const nlohmann::json *(const char *Key)>;

/// What k4 of a pinhole is whose model is not FULL_OPENCV.
enum class FourthTerm {
  Unknown, ///< OpenCV's first under the fraction, or of r^8 above it: refused
  Above    ///< of r^8, as nerfstudio has it
};

/// Reads a camera's lens. Names of models are those of \c lensModelNamed, under
/// the keys camera_model, lens_model, model, camera_type, projection,
/// projection_type, or is_fisheye; coefficients k1 to k6, p1, p2, s1 to s4, or
/// OpenCV's dist_coeffs, or gsplat's radial_coeffs, tangential_coeffs and
/// thin_prism_coeffs. Without a model's name they are OPENCV's. A lens without
/// an effect is a pinhole. Refused: values of another type, unknown models, two
/// models, and coefficients that the model does not have. The error's place is
/// empty.
Expected<CameraModel> readLens(const KeyFinder &Find,
                               FourthTerm K4 = FourthTerm::Unknown);

/// \p M as readLens() reads it: its name and its coefficients; null for a
/// pinhole.
nlohmann::json lensJson(const CameraModel &M);

/// Gives \p C, whose lens covers the sphere and whose size is there, its focal
/// lengths and principal point: it sees the full sphere.
void setSphere(Camera &C);

} // namespace vorion::splat
