/// Photographs with poses, for training.
#pragma once

#include "io/LocalFrame.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

enum class CaptureFormat {
  ColmapText,
  ColmapBinary,
  NerfSynthetic,
  Transforms
};

/// The name in reports: colmap-text, colmap-binary, nerf-synthetic, transforms.
std::string_view name(CaptureFormat F);

/// A photograph with its camera.
struct CaptureView {
  Camera Pose; ///< named after the picture in the capture
  /// The lens of the photograph. Pose has the same focal lengths and principal
  /// point, but is a pinhole: users of the picture must undistort it, or assign
  /// this lens to the pose.
  CameraModel Optics;
  std::string Picture; ///< the file
  /// The EXIF orientation by which the stored picture must be turned
  /// (\c turned()), as its camera is.
  int Orientation = 1;
  std::string Mask;     ///< the file of the mask, or empty
  bool HeldOut = false; ///< used only for evaluation
  /// Indices of the capture's points that are visible in it; empty in most
  /// formats.
  std::vector<uint32_t> Sees;
};

/// The points of a capture.
struct CapturePoints {
  std::vector<double> Positions; ///< 3 each, world units
  std::vector<uint8_t> Colours;  ///< 3 each: r, g, b
  /// From where training measures them and its scene, in fp32: 0, or near them
  /// where fp32 has too few digits (\c localOrigin()).
  WorldPoint Origin{};

  std::size_t size() const { return Colours.size() / 3; }
  WorldPoint at(std::size_t I) const {
    return {Positions[3 * I], Positions[3 * I + 1], Positions[3 * I + 2]};
  }
  std::vector<float> local() const; ///< all positions from Origin
};

/// Axes are those of the file, without rotation or scaling. Camera axes are x
/// right, y down, z forward for all formats.
struct Capture {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  std::vector<CaptureView> Views; ///< sorted by name (bytewise)
  CapturePoints Points;           ///< may be empty for transforms.json
  /// Number of skipped views without a picture: captures are often distributed
  /// partially.
  std::size_t WithoutPicture = 0;
  std::size_t masked() const; ///< views with a mask
  /// Number of views with lens distortion or rolling shutter.
  std::size_t distorted() const;
  /// Number of these that cannot be undistorted: spheres and rolling shutters.
  std::size_t photographsAlone() const;
  /// The criterion for held-out views, as text.
  std::string HeldOutBy;
  /// Lines for users about choices of the reader: which model it took, names
  /// that are not those of their files, pictures of another size.
  std::vector<std::string> Notes;

  std::size_t heldOut() const;
  std::vector<Camera> poses() const; ///< of all views
};

/// The centre of the training cameras and the largest distance from it: 0 if
/// the positions are equal in fp32.
struct CameraRing {
  std::array<double, 3> Centre{};
  double Radius = 0;

  /// The unit of length of learning rates and density control.
  double extent() const { return 1.1 * Radius; }
};
CameraRing cameraRing(const Capture &C);

/// The extent of the ring, or if all training cameras are at one place, the
/// median distance of the points from it; 0 without points.
double sceneExtent(const Capture &C);

/// Default interval of held-out views, sorted by name, from the first view on.
inline constexpr std::size_t HoldOutEvery = 8;

/// The pixels that are used: all, those that are not transparent, or those of
/// mask files.
enum class MaskSource { None, Alpha, Files };
constexpr std::string_view name(MaskSource M) {
  return M == MaskSource::None    ? "none"
         : M == MaskSource::Alpha ? "alpha"
                                  : "files";
}

/// The picture of a capture's camera: the original photograph, or the
/// undistorted picture of a pinhole.
enum class LensOf { Undistorted, Photograph };

/// Options for reading a capture.
struct CaptureOptions {
  /// Names of views to skip (with or without folder and extension).
  std::vector<std::string> Exclude;
  /// Whether pictures and points may be outside the capture's folder.
  bool AllowOutside = false;
  MaskSource Masks = MaskSource::None;
  /// The pictures to use. Spheres and rolling shutters need LensOf::Photograph.
  LensOf Pictures = LensOf::Undistorted;
  /// Interval of held-out views, sorted by name; 0: none. Default: that of the
  /// capture, or HoldOutEvery.
  std::optional<unsigned> HoldOut = std::nullopt;
  /// The folder of the pictures, in the capture's folder or elsewhere; empty:
  /// where the capture has them.
  std::string Images = {}; // NOLINT(readability-redundant-member-init)
};

/// Reads the capture at \p Path, a folder or a transforms.json:
/// - `sparse/0`, `sparse` or the folder itself contains COLMAP's cameras,
///   images and points3D as .bin or .txt, and `images` the pictures; or they
///   are in other folders (docs/captures.md);
/// - `transforms_train.json`; `transforms_test.json`, if present, contains the
///   held-out views;
/// - `transforms.json`. Pictures are not decoded, but each must exist once,
///   be inside the folder unless \p Options allow otherwise. The intrinsics of
///   a picture of another size than its camera are scaled. Views without a
///   picture are skipped and counted.
///
/// With \c MaskSource::Files, the mask of the picture NAME is `mask_path` of
/// its frame, or the first of masks/NAME.png, masks/NAME, and masks/NAME with
/// the extension .png. A picture without a mask is used completely.
Expected<Capture> readCapture(const std::string &Path,
                              const CaptureOptions &Options = {});

/// The poses of a capture, without pictures and points.
struct CaptureCameras {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  std::vector<Camera> Cameras;    ///< sorted by name (bytewise)
  std::vector<std::string> Files; ///< the files that were read
};

/// Reads them from the same inputs as readCapture, from a folder with only
/// COLMAP's files, or from one of COLMAP's files. Pictures are opened only if
/// transforms.json specifies no size. Lenses are pinholes, or those of the
/// photographs, as \p Of selects.
Expected<CaptureCameras> readCaptureCameras(const std::string &Path,
                                            LensOf Of = LensOf::Undistorted);

/// The files at \p Path that readCapture or readCaptureCameras may read, with
/// all existing pictures, masks and points; only \p Path if it is no capture.
std::vector<std::string> captureFiles(const std::string &Path);

/// Whether \p Path looks like an input of readCapture, by file names.
bool isCapture(const std::string &Path);

} // namespace vorion::splat
