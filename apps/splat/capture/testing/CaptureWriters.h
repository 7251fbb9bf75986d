/// Writers of small captures in every format, for tests only, independent of
/// the readers.
#pragma once

#include "scene/testing/SceneWriters.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vorion::splat::testing {

/// The content of a test capture. Poses are world to camera, as in COLMAP.
struct SampleCapture {
  struct View {
    std::string Name;
    std::array<double, 4> Quaternion{1, 0, 0, 0}; ///< w, x, y, z
    std::array<double, 3> Translation{};
  };
  struct Point {
    std::array<double, 3> Position{};
    std::array<uint8_t, 3> Colour{};
    /// Indices of views, for COLMAP's tracks.
    // May be left out: NOLINTNEXTLINE(readability-redundant-member-init)
    std::vector<std::size_t> SeenBy{};
  };
  int Width = 8, Height = 6;
  double Fx = 10, Fy = 11, Cx = 4.25, Cy = 3;
  std::vector<View> Views;
  std::vector<Point> Points;
};

/// \p Views cameras on a circle around the origin that look at it, and 12
/// points, each visible in two of them; names a0.png, a1.png, ...
SampleCapture sampleCapture(std::size_t Views = 10);

/// sparse/0/{cameras,images,points3D}.bin or .txt, and images/ with pictures of
/// one colour each.
Folder colmapBinaryOf(const SampleCapture &C);
Folder colmapTextOf(const SampleCapture &C);
/// transforms.json with fl_x, and the pictures.
Folder transformsOf(const SampleCapture &C);
/// transforms_train.json and transforms_test.json (the last two views) with
/// camera_angle_x, names without extension.
Folder nerfSyntheticOf(const SampleCapture &C);

/// The points as a binary PLY, for transforms.json.
std::string pointCloudOf(const SampleCapture &C);

/// An 8-bit RGBA PNG.
std::string pngOf(int Width, int Height, const std::string &Rgba);
/// A nearly lossless JPEG of the colours of \p Rgba.
std::string jpegOf(int Width, int Height, const std::string &Rgba);

} // namespace vorion::splat::testing
