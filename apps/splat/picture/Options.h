/// Options of a rendering, named as on the command line.
#pragma once

#include "io/CameraModel.h"
#include "picture/TailRule.h"
#include "scene/Drawing.h"
#include "splat/LaneUnits.h" // generated from intrinsics/Units.td

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The rendering convention.
enum class Rules { Inria, Gsplat };
/// Rule for the pixels that a Gaussian covers.
enum class Support { Exact, Box3, Square3, Official16 };
/// Unit that blends: the rasterizer or the cores.
enum class Path { Raster, Simt };

/// Distribution of tiles to the rasterizers: by the lengths of their lists, or
/// by their cost in the previous picture.
enum class Dealing { Lists, LastFrame };

/// How a Gaussian becomes an ellipse on the picture: by the camera's Jacobian
/// at its mean, or by seven of its points (3DGUT's unscented transform).
enum class Spread { Jacobian, Unscented };

/// By which depth a pixel blends Gaussians: that of their centres, or that
/// along the pixel's own ray.
enum class PixelOrder { Depth, Ray };

/// Format of the depths that a mesh's triangles are tested by: floats, or
/// integers of 24 or 16 bits, which are the near plane's depth over z times the
/// largest.
enum class DepthFormat { Fp32, Unorm24, Unorm16 };
inline constexpr std::array<DepthFormat, 3> DepthFormats{
    DepthFormat::Fp32, DepthFormat::Unorm24, DepthFormat::Unorm16};

constexpr std::string_view name(DepthFormat F) {
  constexpr std::array<std::string_view, 3> Names{"fp32", "unorm24", "unorm16"};
  return Names[static_cast<std::size_t>(F)];
}
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
/// Where a traced ray goes on when its window has been blended: at the root, or
/// where the pass before left something (GRTX's checkpoints).
enum class RayRestart { Root, Checkpoint };
constexpr std::string_view name(RayRestart R) {
  return R == RayRestart::Root ? "root" : "checkpoint";
}
constexpr std::string_view name(Path P) {
  return P == Path::Raster ? "raster" : "simt";
}
/// Whether the cores' path has \p E.
constexpr bool isOnCores(ExpUnit E) { return !kernelOf(E).empty(); }

/// Depth of the near plane: exclusive with INRIA's rules, inclusive with
/// gsplat's.
constexpr float nearLimit(Rules R) { return R == Rules::Inria ? 0.2F : 0.01F; }

inline constexpr unsigned MaxZTiles = 16;

/// Of the set-up of triangles (vorion_triangles.h).
inline constexpr unsigned MaxSubpixelBits = 8;
/// Of the filters of GPUs. Places of 2^15 texels with them are exact in fp32.
inline constexpr unsigned MaxFilterBits = 8;

struct Mesh;

/// The options of one picture that reach the device.
struct RenderOptions {
  RendererKind Kind = RendererKind::Splat;
  /// 2, or 4 of rays and traced rays (Drawing).
  unsigned FalloffDegree = 2;
  Rules Convention = Rules::Inria;
  Support Reach = Support::Exact;
  Path Blending = Path::Raster;
  ExpUnit Exponential = ExpUnit::Exact;
  BlendUnit Arithmetic = BlendUnit::Fp32;
  /// Minimum alpha that is blended, in units of 1/255: 1, 2, 4 or 8.
  unsigned AlphaCutoff = 1;
  /// What the cameras are; pinholes among OpenCV's count as such.
  const LensModel *Optics = CameraModel().Model;
  Spread Through = Spread::Jacobian;
  /// Whether a camera moves while it exposes.
  bool Rolling = false;
  /// Depth of the near plane; empty: that of the rules.
  std::optional<float> Near;
  /// Number of leading depth bits in the sort key: 1 to 32.
  unsigned DepthBits = 32;
  /// Maximum degree of spherical harmonics.
  int ShLimit = 3;
  bool Antialiased = false;
  /// What decided that: an option, or what the scene's file says; empty where
  /// nothing did.
  std::string AntialiasedBy;
  /// Added to both variances on the picture, px^2: both conventions' low-pass.
  float Dilation = 0.3F;
  std::array<float, 3> Background{0, 0, 0};
  /// A pixel is saturated when its transmittance would fall below this: [0, 1).
  float Cutoff = 1e-4F;
  /// Culls blocks of Gaussians outside a pinhole's frustum.
  bool CullBlocks = false;
  /// A mesh that is drawn with the Gaussians, or null.
  std::shared_ptr<const Mesh> Surface;
  /// Whether it is a mirror, which traced rays alone have.
  bool IsMirror = false;
  /// The direction in which a light shines on the mesh, of length 1, in the
  /// world's axes.
  std::optional<std::array<float, 3>> Light;
  /// Sub-pixel bits of the mesh's corners on the picture: 1 to
  /// MaxSubpixelBits.
  unsigned SubpixelBits = MaxSubpixelBits;
  DepthFormat MeshDepth = DepthFormat::Fp32;
  /// Bits of the fractions by which texture filters weight texels and levels: 1
  /// to MaxFilterBits; empty: fp32.
  std::optional<unsigned> FilterBits;
  /// Whether the mesh in each pixel is read back (RenderResult::MeshShown).
  bool KeepVisible = false;

  /// Tile size, px: 16, 32 or 64 of the rasterizers, 8, 16, 32 or 64 of the
  /// cores; empty: the path's default.
  std::optional<unsigned> Tile;

  /// \name The rasterizers' path
  /// @{
  /// Depth segments of each tile's list, blended independently and merged: 1 to
  /// MaxZTiles.
  unsigned ZTiles = 1;
  TailRule PixelUnit;
  bool SkipSaturated = false;
  Dealing Deal = Dealing::Lists;
  /// @}

  /// \name The cores' path
  /// @{
  unsigned SimtGroup = 256; ///< work-items that draw a tile
  PixelOrder Order = PixelOrder::Depth;
  /// Gaussians that a pixel selects per pass over its list, the nearest along
  /// its ray: 4, 8 or 16.
  unsigned RayWindow = 16;
  /// Where the next pass of a traced ray begins.
  RayRestart Restart = RayRestart::Root;
  /// @}

  /// Render for a backward pass: smaller tiles of the rasterizer
  /// (docs/rasterizer.md, "The backward mode"), last contributors kept.
  bool Training = false;

  /// Whether a pixel takes more than four words of the rasterizer's buffer,
  /// which then holds half as many (docs/primitives.md, "Words a pixel").
  bool hasWidePixels() const {
    return Training || (Surface && Tile.value_or(64) == 64);
  }

  float nearLimit() const {
    return Near.value_or(splat::nearLimit(Convention));
  }
  /// The factor of 1/z in depths of MeshDepth.
  float depthScale() const {
    switch (MeshDepth) {
    case DepthFormat::Fp32:
      return 1;
    case DepthFormat::Unorm24:
      return nearLimit() * 16777215.0F;
    case DepthFormat::Unorm16:
      return nearLimit() * 65535.0F;
    }
    return 1;
  }
  /// Whether depth is the distance from the camera, not z.
  bool byDistance() const { return Optics->byDistance(); }

  /// Width and height of a tile of the path, px.
  unsigned tileSize() const {
    if (Blending == Path::Simt)
      return Tile.value_or(16);
    return hasWidePixels() ? 32 : Tile.value_or(64);
  }
  unsigned tileHeight() const {
    return Blending == Path::Raster && hasWidePixels() ? 64 : tileSize();
  }
};

/// Applies the rendering mode of the scene's file, or the user's override; rays
/// have neither dilation nor what makes up for it.
void drawAs(RenderOptions &O, const Drawing &D);

} // namespace vorion::splat
