/// What a render is asked to do, as the command line names it.
#pragma once

#include "TailRule.h"

#include <array>
#include <string>
#include <string_view>

namespace vorion::splat {

/// The public 3DGS convention that is followed.
enum class Rules { Inria, Gsplat };
/// Which pixels a Gaussian may reach.
enum class Support { Exact, Box3, Square3, Official16 };
/// Who blends: the rasterizer, or the cores alone.
enum class Path { Raster, Simt };
/// The rasterizer's exponential unit.
enum class ExpUnit { Exact, Table };

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
constexpr std::string_view name(ExpUnit E) {
  return E == ExpUnit::Exact ? "exact" : "table";
}

inline constexpr unsigned MaxZTiles = 16;

/// The options of one picture that reach the device.
struct RenderOptions {
  Rules Convention = Rules::Inria;
  Support Reach = Support::Exact;
  Path Blending = Path::Raster;
  ExpUnit Exponential = ExpUnit::Exact;
  bool Antialiased = false;
  /// Added to both variances on the picture, px^2: both conventions' low-pass.
  float Dilation = 0.3F;
  std::array<float, 3> Background{0, 0, 0};
  /// A pixel is full when its transmittance would fall below this: [0, 1).
  float Cutoff = 1e-4F;

  /// \name The rasterizers' path
  /// @{
  /// Depth parts of each tile's list, blended apart and merged: 1 to
  /// MaxZTiles.
  unsigned ZTiles = 1;
  TailRule PixelUnit;
  bool SkipSaturated = false;
  /// @}

  /// \name The cores' path: pixels a side of a tile, work-items that draw it
  /// @{
  unsigned SimtTile = 16;
  unsigned SimtGroup = 256;
  /// @}

  /// Side of a tile, px: the rasterizer's largest, or the cores'.
  unsigned tileSize() const { return Blending == Path::Raster ? 64 : SimtTile; }
};

} // namespace vorion::splat
