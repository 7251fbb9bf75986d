/// Where in a picture the rasterizers' work is, tile by tile.
#pragma once

#include "io/Image.h"

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// Of a tile, summed over its commands (depth parts have one each).
struct TileWork {
  int X = 0, Y = 0, Width = 0, Height = 0; ///< in pixels of the picture
  uint64_t List = 0;                       ///< entries
  uint64_t Blends = 0; ///< into a pixel, those of the pixel unit included
  uint64_t Cycles = 0; ///< of the rasterizer
  uint64_t PixelUnitCycles = 0;
  uint64_t Pixels = 0;    ///< of all commands
  uint64_t Saturated = 0; ///< of these
};

/// Adds up what the device wrote (VORION_TILES, docs/debugging.md), in rows.
/// Errors: a line that is none of those.
Expected<std::vector<TileWork>> readTileWork(const std::string &File);

enum class Heat { List, Blends, Cycles, Saturation };
inline constexpr std::array Heats{Heat::List, Heat::Blends, Heat::Cycles,
                                  Heat::Saturation};
/// "list", "blends", "cycles", "saturation".
std::string_view name(Heat H);
/// Saturation is in per cent of the pixels.
double valueOf(const TileWork &T, Heat H);
/// The value of the brightest colour; that of the darkest is 0. Saturation's
/// is 100, that of the others the largest of \p Tiles.
double scaleOf(const std::vector<TileWork> &Tiles, Heat H);

/// A picture of \p Width times \p Height pixels in which every tile has the
/// colour of its value, and a legend of LegendHeight rows below: the colours
/// from 0 to the scale's end, with both numbers.
Image drawHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
               int Height);
inline constexpr int LegendHeight = 24;

/// The scales, and each tile with all its figures.
nlohmann::ordered_json heatJson(const std::vector<TileWork> &Tiles);

} // namespace vorion::splat
