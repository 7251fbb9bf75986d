/// The workload of a view for tile-based rendering, independent of the machine:
/// counts, not times.
#pragma once

#include "reference/Render.h"
#include "reference/Tiles.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Tile sizes that are compared, px.
inline constexpr std::array<int, 4> AnalyzedTiles = {16, 32, 64, 128};
/// All supports, in the order of their enumeration.
inline constexpr std::array<reference::Support, 4> AnalyzedSupports = {
    reference::Support::Exact, reference::Support::Box3,
    reference::Support::Square3, reference::Support::Official16};

/// (Gaussian, tile) pairs for each of \c AnalyzedTiles: the number of fetches
/// and set-ups of Gaussians. Official16 has tiles of 16 pixels by definition,
/// so pairs of larger tiles are those that contain such a tile.
using Invocations = std::array<uint64_t, AnalyzedTiles.size()>;

/// How values are distributed; zeros where there are none.
struct Distribution {
  uint64_t Count = 0;
  double Mean = 0;
  std::array<double, 101> Percentiles{}; ///< from the least to the largest
};

/// Statistics of the lists for one tile size.
struct ListStatistics {
  uint64_t Tiles = 0, Empty = 0, Longest = 0;
  double Mean = 0; ///< entries a tile, empty ones included
  /// Histogram of list lengths: [0] counts empty lists, [k] lists of 2^(k-1) to
  /// 2^k - 1 entries.
  std::vector<uint64_t> Histogram;
  Distribution Filled; ///< entries of the lists that are not empty
  /// [p]: the fraction of all pixels that are saturated after p % of the
  /// entries of their tile's list.
  std::array<double, 101> Occluded{};
};

struct Analysis {
  uint64_t Visible = 0; ///< Gaussians that reach a tile of 16 pixels
  std::array<Invocations, AnalyzedSupports.size()> BySupport{};
  /// Under the chosen support, for each of \c AnalyzedTiles.
  std::array<ListStatistics, AnalyzedTiles.size()> Lists;
  uint64_t Pixels = 0, Covered = 0, Saturated = 0, Blends = 0;
  double MeanTransmittance = 0;
  /// Blends of covered pixels; visited entries of pixels whose list of 16x16
  /// is not empty; alpha of the blends.
  Distribution BlendsEach, WalkedEach, Alpha;
};

/// Analyzes the view \p C of \p G. Projection and blending are those of \p O in
/// fp32, as on the device, so the counts are equal; \c TileSize of \p O is
/// ignored.
Analysis analyze(const reference::Gaussians<float> &G,
                 const reference::Camera<float> &C,
                 const reference::Options &O);

/// Relative reduction of pairs from the first to the last tile size, 0 to 1.
double reduction(const Invocations &I, std::size_t From, std::size_t To);

} // namespace vorion::splat
