/// Photographs with poses, to train from.
#pragma once

#include "io/Cameras.h"
#include "vorion/support/Expected.h"

#include <array>
#include <cstddef>
#include <cstdint>
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
  Camera Pose;          ///< its name is the picture's, as the capture has it
  std::string Picture;  ///< the file
  bool HeldOut = false; ///< for evaluation only, never trained on
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
  /// Held-out views of transforms_test.json that have no picture, and are left
  /// out: test sets are often passed on in part.
  std::size_t WithoutPicture = 0;
  /// What decided which views are held out, for people.
  std::string HeldOutBy;

  std::size_t heldOut() const;
};

/// The centre of the training cameras and how far the farthest one is from it.
struct CameraRing {
  std::array<double, 3> Centre{};
  double Radius = 0;

  /// What learning rates and density control measure lengths by.
  double extent() const { return 1.1 * Radius; }
};
CameraRing cameraRing(const Capture &C);

/// Every so many-th view by name is held out, the first one included.
inline constexpr std::size_t HoldOutEvery = 8;

/// What who reads a capture may choose.
struct CaptureOptions {
  /// Views to leave out, by name (with or without folder and ending).
  std::vector<std::string> Exclude;
  /// Whether pictures and points may lie outside the capture's folder.
  bool AllowOutside = false;
};

/// Reads the capture at \p Path, a folder or a transforms.json:
/// - `sparse/0`, `sparse` or the folder itself with COLMAP's cameras, images
///   and points3D as .bin or .txt; pictures in `images`;
/// - `transforms_train.json`, whose `transforms_test.json`, if there, has the
///   views to hold out;
/// - `transforms.json`.
/// Pictures are looked at, not decoded: each must be there, once, of the size
/// that its camera says, and inside the folder unless \p Options allow more.
Expected<Capture> readCapture(const std::string &Path,
                              const CaptureOptions &Options = {});

/// Whether \p Path is a folder or file that readCapture would take, as far as
/// names tell.
bool isCapture(const std::string &Path);

} // namespace vorion::splat
