/// Reads cameras from a file or folder of any supported format.
#pragma once

#include "capture/Capture.h"
#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The cameras of a file, and the files that they were read from.
struct CameraFile {
  std::vector<Camera> Cameras;
  std::vector<std::string> Files;
};

/// Reads the cameras at \p Path, in the format that its content indicates:
/// - a JSON list is INRIA's cameras.json; an object with frames is
///   transforms.json; an object with camera_path or keyframes is nerfstudio's
///   camera path;
/// - a folder is a capture (Capture.h), which needs no pictures, or contains
///   the cameras.json of INRIA's trainer. \p Of selects the lenses of a
///   capture's cameras; other files define their own lenses.
Expected<CameraFile> readCameraFile(const std::string &Path,
                                    LensOf Of = LensOf::Undistorted);

/// The files that readCameraFile() reads at \p Path, and the files of its
/// views: for a capture also pictures, masks and points (captureFiles).
std::vector<std::string> cameraFiles(const std::string &Path);

/// Hash of the files from which \p Path's cameras are read: of the content of
/// one file, or of the names and contents of several.
Expected<std::string> hashCameraFile(const std::string &Path);

} // namespace vorion::splat
