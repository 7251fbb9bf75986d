/// The contributions to each pixel. The device returns three channels per pixel
/// and no lists, so the host evaluates the lists and projected Gaussians of the
/// device, with the device's arithmetic.
#pragma once

#include "picture/Layout.h"
#include "picture/Options.h"
#include "render/Pipeline.h"

#include <array>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// The lists of one picture.
struct PixelLists {
  std::array<uint32_t, 2> Size{};     ///< size of the picture, px
  std::array<uint32_t, 2> TileSize{}; ///< px
  /// Records of each window, in the order of windows; a picture without windows
  /// is one.
  std::vector<splat_gaussian> Records;
  /// In their place, where the picture has records of rays.
  std::vector<splat_ray_gaussian> Rays;
  splat_windows Windows{31, 1, 0};
  std::vector<float> Depths;  ///< of each record; undefined if invisible
  std::vector<uint32_t> List; ///< lists of all tiles; indices of records in a
                              ///< window
  std::vector<std::array<uint32_t, 2>> Ranges; ///< of each tile in the list
  uint32_t Stride = 0; ///< record i belongs to Gaussian i % Stride of the scene

  std::size_t pixels() const { return std::size_t{Size[0]} * Size[1]; }
};

/// Copies the lists of \p F, rendered with \p O, to the host.
PixelLists readLists(Launcher &Launch, const Frame &F, const RenderOptions &O);

/// Whether the host supports the arithmetic of \p O: exact exponential, fp32
/// blending, one depth segment.
bool hasPixelLists(const RenderOptions &O);

/// The Gaussians with the largest weights of each pixel.
struct Contributors {
  /// The requested number for each pixel, in descending order of weight, the
  /// nearer of equal weights first; padded with -1 and 0.
  std::vector<int32_t> Indices; ///< in the scene
  std::vector<float> Weights;   ///< alpha times the transmittance before it
  std::vector<int32_t> Counts;  ///< number of Gaussians that each pixel blends
};
Contributors topContributors(const PixelLists &L, const RenderOptions &O,
                             unsigned Most);

/// The depth of the Gaussian after which a pixel's transmittance is at most a
/// half; otherwise that of the last Gaussian; 0 without Gaussians. Where rays
/// of a pinhole meet a Gaussian, the depth of that point, else of the mean.
std::vector<float> medianDepths(const PixelLists &L, const RenderOptions &O);

} // namespace vorion::splat
