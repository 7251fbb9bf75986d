/// What each pixel is made of. The device's pixels have three channels and no
/// lists, so the host goes through the lists and projected Gaussians that the
/// device has made, by the device's arithmetic.
#pragma once

#include "picture/Layout.h"
#include "picture/Options.h"
#include "render/Pipeline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Of one picture.
struct PixelLists {
  std::array<uint32_t, 2> Size{};     ///< picture, px
  std::array<uint32_t, 2> TileSize{}; ///< px
  /// Those of each window, one window after the other; a whole picture is one.
  std::vector<splat_gaussian> Records;
  splat_windows Windows{31, 1, 0};
  std::vector<float> Depths;  ///< of each record; of one not seen, anything
  std::vector<uint32_t> List; ///< of all tiles; numbers of records in a window
  std::vector<std::array<uint32_t, 2>> Ranges; ///< of each tile in the list
  uint32_t Stride = 0; ///< record i shows Gaussian i % Stride of the scene

  std::size_t pixels() const { return std::size_t{Size[0]} * Size[1]; }
};

/// Copies those of \p F, which \p O drew, to the host.
PixelLists readLists(Launcher &Launch, const Frame &F, const RenderOptions &O);

/// That the host's arithmetic is that of \p O: exact exponential, blends in
/// fp32, one depth part.
bool hasPixelLists(const RenderOptions &O);

/// The Gaussians with the largest weights of each pixel.
struct Contributors {
  /// For each pixel so many as were asked for, the largest weight first, and of
  /// equal ones the nearer; then -1 and 0.
  std::vector<int32_t> Indices; ///< in the scene
  std::vector<float> Weights;   ///< alpha times the transmittance in front
  std::vector<int32_t> Counts;  ///< that the pixel blends, of each pixel
};
Contributors topContributors(const PixelLists &L, const RenderOptions &O,
                             unsigned Most);

/// The depth of the Gaussian behind which a pixel's transmittance is at most a
/// half; of the last one where more is left, and 0 where there is none.
std::vector<float> medianDepths(const PixelLists &L, const RenderOptions &O);

} // namespace vorion::splat
