/// What a view asks of a machine that draws it tile by tile, whatever the
/// machine: counts, and no times.
#pragma once

#include "reference/Render.h"
#include "reference/Tiles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Sides of the square tiles that are compared, px.
inline constexpr std::array<int, 4> AnalyzedTiles = {16, 32, 64, 128};
/// All supports, in the order of their enumeration.
inline constexpr std::array<reference::Support, 4> AnalyzedSupports = {
    reference::Support::Exact, reference::Support::Box3,
    reference::Support::Square3, reference::Support::Official16};

/// (Gaussian, tile) pairs for each of \c AnalyzedTiles: how often a Gaussian is
/// fetched and set up. Official16 has tiles of 16 pixels by definition, and so
/// the pairs of larger ones are those that hold such a tile.
using Invocations = std::array<uint64_t, AnalyzedTiles.size()>;

/// The lists of one tile size.
struct ListStatistics {
  uint64_t Tiles = 0, Empty = 0, Longest = 0;
  double Mean = 0; ///< entries a tile, empty ones included
  /// Tiles by length: [0] has none, [k] has 2^(k-1) to 2^k - 1 entries.
  std::vector<uint64_t> Histogram;
  /// [p]: the share of all pixels that are full, so that nothing more is
  /// blended, once p % of the entries of their own tile's list are done.
  std::array<double, 101> Occluded{};
};

struct Analysis {
  uint64_t Visible = 0; ///< Gaussians that reach a tile of 16 pixels
  std::array<Invocations, AnalyzedSupports.size()> BySupport{};
  /// Under the chosen support, for each of \c AnalyzedTiles.
  std::array<ListStatistics, AnalyzedTiles.size()> Lists;
  uint64_t Pixels = 0, Covered = 0, Saturated = 0, Blends = 0;
  double MeanTransmittance = 0;
};

/// Analyzes \p G as \p C sees it. Projection and blending are those of \p O in
/// fp32, as the device does them, so its counts are these; \c TileSize of \p O
/// changes nothing.
Analysis analyze(const reference::Gaussians<float> &G,
                 const reference::Camera<float> &C,
                 const reference::Options &O);

/// How many fewer pairs there are with the last tile size than with the first,
/// 0 to 1.
double reduction(const Invocations &I, std::size_t From, std::size_t To);

} // namespace vorion::splat
