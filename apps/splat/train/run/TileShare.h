/// Divides the tiles of pictures over the processes of a training run.
#pragma once

#include "render/TileDivision.h"
#include "train/run/Ranks.h"

#include <vector>

namespace vorion::splat {

/// The first rows of tiles of \p Processes processes, and the number of rows:
/// stretches of about the same \p Work, which is given for each row.
std::vector<uint32_t> balancedRows(const std::vector<uint64_t> &Work,
                                   unsigned Processes);

class TileShare : public TileDivision {
public:
  TileShare(Launcher &Launch, Ranks &Processes)
      : Launch(Launch), Processes(Processes) {}

  void keepOwn(const Frame &F, uint32_t TileHeight) override;
  void completePixels(const Frame &F) override;
  void completePairs(const Frame &F, const cl::Buffer &Sums,
                     uint32_t Words) override;
  PixelRows ownRows() const override { return rowsOf(Processes.rank()); }
  void completeStrips(std::span<float> Values, uint32_t Planes, uint32_t Strips,
                      uint32_t Height) override;

private:
  PixelRows rowsOf(unsigned Process) const {
    return {FirstRows[Process], FirstRows[Process + 1]};
  }

  Launcher &Launch;
  Ranks &Processes;
  /// \name Of the last picture: the first of each process, and the number
  /// @{
  std::vector<uint32_t> FirstRows;  ///< of pixels
  std::vector<uint64_t> FirstPairs; ///< in the lists
  /// @}
  /// Reused.
  std::vector<float> Copied;
  std::vector<uint32_t> Places;
};

} // namespace vorion::splat
