/// Division of the tiles of a picture over processes.
#pragma once

#include "device/Launcher.h"

#include <cstdint>
#include <span>

namespace vorion::splat {

struct Frame;

/// Each process has all Gaussians and lists, and blends some rows of tiles.
/// What the others have blended is completed where it is next needed, so that
/// all later results are bit-identical in all processes, for any number of
/// them. All calls but \c ownRows are collective. The launcher keeps errors;
/// after an error in one process, all have it.
class TileDivision {
public:
  virtual ~TileDivision() = default;

  /// Empties the lists of \p F of other processes' tiles, which are \p
  /// TileHeight high, px.
  virtual void keepOwn(const Frame &F, uint32_t TileHeight) = 0;
  /// Copies the pixels of other processes' tiles to \p F.
  virtual void completePixels(const Frame &F) = 0;
  /// Copies to \p Sums, \p Words floats for each pair of \p F, those of other
  /// processes' pairs.
  virtual void completePairs(const Frame &F, const cl::Buffer &Sums,
                             uint32_t Words) = 0;

  /// Rows of pixels, from \c First to before \c End.
  struct PixelRows {
    uint32_t First = 0, End = 0;
  };
  /// Those of this process in the last picture.
  virtual PixelRows ownRows() const = 0;
  /// Completes \p Planes planes of \p Values for the last picture. A plane has
  /// \p Strips strips of \p Height rows of pixels. The process that has a
  /// strip's first row has set the strip's values.
  virtual void completeStrips(std::span<float> Values, uint32_t Planes,
                              uint32_t Strips, uint32_t Height) = 0;
};

} // namespace vorion::splat
