/// The range of a list that each pixel of a tile takes (docs/primitives.md,
/// "Ranges").
#pragma once

#include "raster/Datapath.h"
#include "raster/Job.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::raster {

/// Opens and closes the pixels of a tile as its list goes on: outside of its
/// range a pixel takes nothing, as a saturated one.
class PixelRanges {
public:
  /// Closes the pixels of \p Of that have not begun. \p J was not refused.
  PixelRanges(const Job &J, RasterMemory &Memory, TileBuffer &Of);

  /// The first entry that any pixel takes, at most \p Count.
  uint32_t first(uint32_t Count) const;

  /// Opens and closes what entry \p Entry, which is above those before, begins
  /// and ends. Whether a pixel takes it, or may take one after it.
  bool goTo(uint32_t Entry);

  /// Pixels that are open or have not begun, of the tile and of a row.
  uint32_t left() const {
    return Tile.Live + static_cast<uint32_t>(Begins.size());
  }
  uint64_t leftOf(unsigned Row) const;

  /// The pixel as it goes to memory.
  Pixel written(unsigned Row, unsigned Column) const;

private:
  struct Turn {
    uint32_t Entry;
    uint8_t Row, Column;
  };
  void setOpen(const Turn &Pixel, bool IsOpen);

  TileBuffer &Tile;
  unsigned Width, Height; ///< of the tile
  bool KeepsSaturated;
  std::vector<Turn> Begins, Ends; ///< to come, the nearest last
  /// Pixels that are closed by their ranges, a bit each.
  std::array<uint64_t, TileBuffer::Stride> Outside{};
};

} // namespace vorion::raster
