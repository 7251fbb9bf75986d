/// The project's only definitions of picture differences.
///
/// For numerics, PSNR has peak 1 and is taken on linear, unclamped floats over
/// all channels: -10 log10(mean squared difference). Equal pictures are at
/// infinity. Against photographs, take it on the 8-bit values that `toByte`
/// gives (\c psnr8Bit); a set's figure is the mean of its pictures' dB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::splat {

/// Differences over the pixels that were compared.
struct Difference {
  std::size_t Pixels = 0; ///< compared
  double PsnrDb = 0;      ///< infinity for equal pictures or no pixel
  double MaxAbs = 0;      ///< largest absolute difference of a channel
};

/// Compares \p A and \p B, both \p Channels values a pixel, over the pixels
/// whose entry of \p Skip is 0 (all, where \p Skip is empty). A NaN on either
/// side, unless both are NaN, makes PSNR minus infinity and MaxAbs infinity.
Difference compare(const std::vector<double> &A, const std::vector<double> &B,
                   std::size_t Channels,
                   const std::vector<std::uint8_t> &Skip = {});

/// PSNR with peak 255 of the clamped, rounded 8-bit values.
double psnr8Bit(const std::vector<float> &A, const std::vector<float> &B);

} // namespace vorion::splat
