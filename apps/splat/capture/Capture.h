/// Photographs with poses, to train from.
#pragma once

#include "io/Cameras.h"
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

/// As reports have it: colmap-text, colmap-binary, nerf-synthetic, transforms.
std::string_view name(CaptureFormat F);

/// One photograph and from where it was taken.
struct CaptureView {
  Camera Pose; ///< its name is the picture's, as the capture has it
  /// Of the camera that took the picture. The pose's focal lengths and
  /// principal point are its, too, but the pose is a pinhole: who uses the
  /// picture undistorts it, or gives the pose this lens.
  CameraModel Optics;
  std::string Picture;  ///< the file
  std::string Mask;     ///< the file that says which pixels count, or empty
  bool HeldOut = false; ///< for evaluation only, never trained on
  /// Which of the capture's points were found in it; few formats know.
  std::vector<uint32_t> Sees;
};

/// Points that came with the poses.
struct CapturePoints {
  std::vector<float> Positions; ///< 3 each, world units
  std::vector<uint8_t> Colours; ///< 3 each: r, g, b

  std::size_t size() const { return Colours.size() / 3; }
};

/// Axes are those of the file: nothing is turned or scaled. Cameras are x
/// right, y down, z forward whatever the format has.
struct Capture {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  std::vector<CaptureView> Views; ///< sorted by name, byte by byte
  CapturePoints Points;           ///< may be empty in a file of transforms
  /// Views that have no picture, and are left out: captures are often passed
  /// on in part.
  std::size_t WithoutPicture = 0;
  std::size_t masked() const; ///< views with a mask
  /// Views whose photograph is no pinhole's, by lens or rolling shutter.
  std::size_t distorted() const;
  /// Those of them that cannot be undistorted: spheres and rolling shutters.
  std::size_t photographsAlone() const;
  /// What decided which views are held out, for people.
  std::string HeldOutBy;

  std::size_t heldOut() const;
};

/// The centre of the training cameras and how far the farthest one is from it:
/// 0 where fp32 would not tell them apart.
struct CameraRing {
  std::array<double, 3> Centre{};
  double Radius = 0;

  /// What learning rates and density control measure lengths by.
  double extent() const { return 1.1 * Radius; }
};
CameraRing cameraRing(const Capture &C);

/// Every so many-th view by name is held out, the first one included.
inline constexpr std::size_t HoldOutEvery = 8;

/// Which pixels count: all, those that are not transparent, or those that mask
/// files say.
enum class MaskSource { None, Alpha, Files };
constexpr std::string_view name(MaskSource M) {
  return M == MaskSource::None    ? "none"
         : M == MaskSource::Alpha ? "alpha"
                                  : "files";
}

/// Which picture of a capture's camera is meant: the photograph as it is, or
/// what a pinhole would have taken.
enum class LensOf { Undistorted, Photograph };

/// What who reads a capture may choose.
struct CaptureOptions {
  /// Views to leave out, by name (with or without folder and ending).
  std::vector<std::string> Exclude;
  /// Whether pictures and points may lie outside the capture's folder.
  bool AllowOutside = false;
  MaskSource Masks = MaskSource::None;
  /// Which pictures it is read for. Of spheres and of rolling shutters there
  /// are photographs alone.
  LensOf Pictures = LensOf::Undistorted;
  /// Every so many-th view by name is held out, 0: none. Without it the capture
  /// decides, or HoldOutEvery.
  std::optional<unsigned> HoldOut = std::nullopt;
};

/// Reads the capture at \p Path, a folder or a transforms.json:
/// - `sparse/0`, `sparse` or the folder itself with COLMAP's cameras, images
///   and points3D as .bin or .txt; pictures in `images`;
/// - `transforms_train.json`, whose `transforms_test.json`, if there, has the
///   views to hold out;
/// - `transforms.json`.
/// Pictures are looked at, not decoded: each must be there once, of the size
/// that its camera says, and inside the folder unless \p Options allow more.
/// Views whose picture is missing are left out and counted.
///
/// With \c MaskSource::Files the mask of the picture NAME is what `mask_path`
/// of its frame names, or else the first of masks/NAME.png, masks/NAME and
/// masks/NAME with .png as its ending; a picture without one counts whole.
Expected<Capture> readCapture(const std::string &Path,
                              const CaptureOptions &Options = {});

/// The poses of a capture, for who needs no picture and no point.
struct CaptureCameras {
  CaptureFormat Format = CaptureFormat::ColmapBinary;
  std::vector<Camera> Cameras;    ///< sorted by name, byte by byte
  std::vector<std::string> Files; ///< what they were read from
};

/// Reads them from where readCapture would, from a folder that holds COLMAP's
/// files alone, or from one of COLMAP's files. A picture is looked at only
/// where a file of transforms says no size. Their lenses are pinholes, or by
/// \p Of those of the photographs.
Expected<CaptureCameras> readCaptureCameras(const std::string &Path,
                                            LensOf Of = LensOf::Undistorted);

/// The files at \p Path that readCapture or readCaptureCameras read, with the
/// pictures, masks and points that are there, whatever their options; \p Path
/// alone where no capture is.
std::vector<std::string> captureFiles(const std::string &Path);

/// Whether \p Path is a folder or file that readCapture would take, as far as
/// names tell.
bool isCapture(const std::string &Path);

} // namespace vorion::splat
