/// Blocks of 4 x 4 pixels that a rasterizer could leave out of a Gaussian's box
/// (docs/ideas.md): what the machine blends does not depend on it.
#pragma once

#include "raster/Datapath.h"

#include <array>
#include <cstdint>

namespace vorion::raster {

/// Why a block is left out; a sum of these.
enum BlockTest : unsigned {
  OutsideEllipse = 1, ///< alpha is below the least in all of it
  ClosedBlock = 2     ///< all of its pixels were closed by earlier Gaussians
};

/// What is left of a box.
struct BlockWork {
  uint16_t Blocks, Pixels; ///< the box's pixels in them
};

/// For one command, Gaussian by Gaussian in the order of its list.
class BlockTests {
public:
  static constexpr unsigned Side = 4;

  explicit BlockTests(unsigned WhichIn) : Which(WhichIn) {}
  bool any() const { return Which != 0; }

  /// The primitive has been blended into \p Tile, which it does not miss. Of a
  /// Gaussian that rays meet there is no ellipse to test.
  BlockWork count(const Gaussian &G, const BoxWork &Box, float MinAlpha,
                  const TileBuffer &Tile);
  BlockWork count(const RayGaussian &, const BoxWork &Box, float MinAlpha,
                  const TileBuffer &Tile);

private:
  static constexpr unsigned PerRow = VR_MAX_TILE / Side;

  template <typename Outside>
  BlockWork count(const BoxWork &Box, const TileBuffer &Tile, Outside IsOut);
  bool isClosed(unsigned X, unsigned Y) const { return Closed[Y] >> X & 1; }
  void close(unsigned X, unsigned Y, const TileBuffer &Tile);

  unsigned Which;
  std::array<uint16_t, PerRow> Closed{}; ///< by row of blocks, a bit each
};

} // namespace vorion::raster
