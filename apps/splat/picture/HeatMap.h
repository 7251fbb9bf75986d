/// Maps of the rasterizers' work per tile of a picture.
#pragma once

#include "device/TileWork.h"
#include "io/Image.h"

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

enum class Heat { List, Blends, Cycles, Saturation };
inline constexpr std::array Heats{Heat::List, Heat::Blends, Heat::Cycles,
                                  Heat::Saturation};
/// "list", "blends", "cycles", "saturation".
std::string_view name(Heat H);
/// Saturation is in per cent of the pixels.
double valueOf(const TileWork &T, Heat H);
/// The maximum of the colour scale, which starts at 0: 100 for saturation, else
/// the maximum over \p Tiles.
double scaleOf(const std::vector<TileWork> &Tiles, Heat H);

/// The colour of the fraction \p Share of the scale, from dark to bright.
std::array<float, 3> heatColour(double Share);

/// A picture of \p Width times \p Height pixels in which every tile has the
/// colour of its value, and a legend of LegendHeight rows below: the colours
/// from 0 to the scale's end, with both numbers.
Image drawHeat(const std::vector<TileWork> &Tiles, Heat H, int Width,
               int Height);
inline constexpr int LegendHeight = 24;

/// The machine and clock of the cycles, the scales, and each tile with all its
/// figures.
nlohmann::ordered_json heatJson(const DrawnTiles &Of);

} // namespace vorion::splat
