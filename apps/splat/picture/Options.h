/// What a render is asked to do, as the command line names it.
#pragma once

#include "io/CameraModel.h"
#include "picture/TailRule.h"
#include "scene/Drawing.h"
#include "splat/LaneUnits.h" // generated from intrinsics/Units.td

#include <array>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The public 3DGS convention that is followed.
enum class Rules { Inria, Gsplat };
/// Which pixels a Gaussian may reach.
enum class Support { Exact, Box3, Square3, Official16 };
/// Who blends: the rasterizer, or the cores alone.
enum class Path { Raster, Simt };

/// How tiles are dealt to the rasterizers: by the lengths of their lists, or by
/// what they were to the rasterizers in the last picture.
enum class Dealing { Lists, LastFrame };

/// How a Gaussian becomes an ellipse on the picture: by the camera's Jacobian
/// at its mean, or by seven of its points (3DGUT's unscented transform).
enum class Spread { Jacobian, Unscented };

/// By which depth a pixel blends Gaussians: that of their centres, or that
/// along the pixel's own ray.
enum class PixelOrder { Depth, Ray };

constexpr std::string_view name(PixelOrder O) {
  return O == PixelOrder::Depth ? "depth" : "ray";
}
constexpr std::string_view name(Dealing D) {
  return D == Dealing::Lists ? "lists" : "last-frame";
}
constexpr std::string_view name(Spread S) {
  return S == Spread::Jacobian ? "jacobian" : "unscented";
}
constexpr std::string_view name(Rules R) {
  return R == Rules::Inria ? "inria" : "gsplat";
}
constexpr std::string_view name(Support S) {
  constexpr std::array<std::string_view, 4> Names{"exact", "box3", "square3",
                                                  "official16"};
  return Names[static_cast<std::size_t>(S)];
}
constexpr std::string_view name(Path P) {
  return P == Path::Raster ? "raster" : "simt";
}
/// Whether the cores' path has \p E.
constexpr bool isOnCores(ExpUnit E) { return !kernelOf(E).empty(); }

/// The least depth that is drawn: beyond it by INRIA's rules, from it on by
/// gsplat's.
constexpr float nearLimit(Rules R) { return R == Rules::Inria ? 0.2F : 0.01F; }

inline constexpr unsigned MaxZTiles = 16;

/// The options of one picture that reach the device.
struct RenderOptions {
  Rules Convention = Rules::Inria;
  Support Reach = Support::Exact;
  Path Blending = Path::Raster;
  ExpUnit Exponential = ExpUnit::Exact;
  BlendUnit Arithmetic = BlendUnit::Fp32;
  /// The smallest alpha that is blended, in 1/255: 1, 2, 4 or 8.
  unsigned AlphaCutoff = 1;
  /// What the cameras are; pinholes among OpenCV's count as such.
  const LensModel *Optics = CameraModel().Model;
  Spread Through = Spread::Jacobian;
  /// Whether a camera moves while it exposes.
  bool Rolling = false;
  /// Least depth that is drawn; nothing: the rules' own.
  std::optional<float> Near;
  /// Leading bits of the depths that decide the order: 1 to 32.
  unsigned DepthBits = 32;
  /// Spherical harmonics of higher bands are left out.
  int ShLimit = 3;
  bool Antialiased = false;
  /// What decided that: an option, or what the scene's file says; empty where
  /// nothing did.
  std::string AntialiasedBy;
  /// Added to both variances on the picture, px^2: both conventions' low-pass.
  float Dilation = 0.3F;
  std::array<float, 3> Background{0, 0, 0};
  /// A pixel is full when its transmittance would fall below this: [0, 1).
  float Cutoff = 1e-4F;
  /// Blocks of Gaussians that a pinhole sees nothing of are left out whole.
  bool CullBlocks = false;

  /// \name The rasterizers' path
  /// @{
  /// Side of a tile, px: 16, 32 or 64.
  unsigned RasterTile = 64;
  /// Depth parts of each tile's list, blended apart and merged: 1 to
  /// MaxZTiles.
  unsigned ZTiles = 1;
  TailRule PixelUnit;
  bool SkipSaturated = false;
  Dealing Deal = Dealing::Lists;
  /// @}

  /// \name The cores' path: pixels a side of a tile, work-items that draw it
  /// @{
  unsigned SimtTile = 16;
  unsigned SimtGroup = 256;
  PixelOrder Order = PixelOrder::Depth;
  /// Gaussians that a pixel takes from its list at a time, the nearest along
  /// its ray: 4, 8 or 16.
  unsigned RayWindow = 16;
  /// @}

  /// Draw so that gradients can be taken back: smaller tiles of the rasterizer
  /// (docs/rasterizer.md, "The backward mode"), last contributors kept.
  bool Training = false;

  float nearLimit() const {
    return Near.value_or(splat::nearLimit(Convention));
  }
  /// Whether depth is the distance from the camera, not z.
  bool byDistance() const { return Optics->byDistance(); }

  /// Width and height of a tile of the path, px.
  unsigned tileSize() const {
    return Blending == Path::Simt ? SimtTile : Training ? 32 : RasterTile;
  }
  unsigned tileHeight() const {
    return Blending == Path::Raster && Training ? 64 : tileSize();
  }
};

/// Draws as the scene's file says, or the user against it.
void drawAs(RenderOptions &O, const Drawing &D);

} // namespace vorion::splat
