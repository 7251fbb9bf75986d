/// Views in INRIA's `cameras.json`.
#pragma once

#include "io/CameraModel.h"
#include "vorion/support/Expected.h"

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// Maximum side of a picture; a larger one is an error in the file.
inline constexpr int MaxImageSize = 16384;

/// A camera: x right, y down, z forward. Pixel (i, j) covers
/// [i, i+1) x [j, j+1); its sample point is the centre.
struct Camera {
  int Id = 0;
  std::string Name;                 ///< img_name
  int Width = 0, Height = 0;        ///< pixels, 1 to MaxImageSize
  std::array<double, 3> Position{}; ///< camera centre, world units
  /// Camera-to-world rows; the columns are the camera's axes.
  std::array<std::array<double, 3>, 3> Rotation{};
  /// Focal lengths, pixels: of a fisheye and an equirectangular camera a
  /// radian, of an orthographic one a unit.
  double Fx = 0, Fy = 0;
  double Cx = 0, Cy = 0; ///< principal point; the picture's centre if absent
  CameraModel Optics;

  /// At the origin, looking along +z; pixels of \p Focal length, the principal
  /// point in the picture's middle.
  static Camera ahead(int Width, int Height, double Focal);

  /// World to camera: row-major R with p_camera = R p_world + t.
  std::array<double, 9> worldToCameraRotation() const;
  std::array<double, 3> worldToCameraTranslation() const;

  bool operator==(const Camera &) const = default;
};

/// Whether \p R is a rotation, to three digits: files with few decimals pass,
/// mirrored or scaled matrices do not.
bool isRotation(const std::array<std::array<double, 3>, 3> &R);

/// Reads all records: id, img_name, width, height, position, rotation, fx, fy
/// and optionally cx, cy and a lens (docs/cameras.md); of an equirectangular
/// one fx to cy say nothing. Keys that call for what is not here
/// (Unsupported.h) are errors, unless they are zero; others are ignored. Every
/// error names file, record and key.
Expected<std::vector<Camera>> readCameras(const std::string &Path);
/// The same for \p Document, the contents of \p Path.
Expected<std::vector<Camera>> parseCameras(const std::string &Path,
                                           const nlohmann::json &Document);

/// The cameras of \p Cameras, from \p Path, selected by \p Views: by name, else
/// by id, else by a unique name without folder, or without folder and
/// extension. The error for an unknown view lists the available ones.
Expected<std::vector<Camera>>
selectCameras(const std::string &Path, const std::vector<Camera> &Cameras,
              const std::vector<std::string> &Views);

/// The camera of \p Path with the img_name \p View, or else with the id \p
/// View; the error for an unknown view lists the available ones.
Expected<Camera> readCamera(const std::string &Path, const std::string &View);

/// The same for each of \p Views; the file is read once.
Expected<std::vector<Camera>>
readCameras(const std::string &Path, const std::vector<std::string> &Views);

/// \p Cameras as readCameras() reads them, with the same doubles.
nlohmann::json camerasJson(const std::vector<Camera> &Cameras);

/// Writes \p Cameras, with cx and cy, so that reading reproduces the same
/// doubles.
Expected<Success> writeCameras(const std::string &Path,
                               const std::vector<Camera> &Cameras);

} // namespace vorion::splat
