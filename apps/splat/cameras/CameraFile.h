/// Cameras from any file or folder that has some.
#pragma once

#include "capture/Capture.h"
#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The cameras of a file, and what they were read from.
struct CameraFile {
  std::vector<Camera> Cameras;
  std::vector<std::string> Files;
};

/// Reads the cameras at \p Path, told by content:
/// - a list is INRIA's cameras.json, an object with frames a file of
///   transforms, one with camera_path or keyframes nerfstudio's camera path;
/// - a folder is a capture (Capture.h), of which no picture is needed, or has a
///   cameras.json, as INRIA's trainer leaves it.
/// \p Of says which lenses those of a capture have; other files' are their own.
Expected<CameraFile> readCameraFile(const std::string &Path,
                                    LensOf Of = LensOf::Undistorted);

/// The files that readCameraFile() reads at \p Path, or that lie under its
/// views: of a capture also pictures, masks and points (captureFiles).
std::vector<std::string> cameraFiles(const std::string &Path);

/// Of the files that \p Path's cameras are read from: of the file, or of the
/// names and contents of several.
Expected<std::string> hashCameraFile(const std::string &Path);

} // namespace vorion::splat
