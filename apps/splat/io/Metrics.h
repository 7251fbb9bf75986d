/// The project's only definitions of the differences of pictures and gradients.
///
/// For numerics, PSNR has peak 1 and is taken on linear, unclamped floats over
/// all channels: -10 log10(mean squared difference). Equal pictures are at
/// infinity. What is no finite number is no picture: it equals nothing, itself
/// neither. Against photographs, take it on the 8-bit values that `toByte`
/// gives (\c psnr8Bit); a set's figure is the mean of its pictures' dB.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace vorion::splat {

/// Differences over the pixels that were compared.
struct Difference {
  std::size_t Pixels = 0; ///< compared
  double PsnrDb = 0;      ///< infinity for equal pictures or no pixel
  double MaxAbs = 0;      ///< largest absolute difference of a channel
  /// Pixels with a value that is no finite number on either side.
  std::size_t NotFinite = 0;
  /// Share of pixels with a channel that differs by more than 1/255.
  double OffShare = 0;
};

/// Side of SSIM's window and its standard deviation, pixels.
inline constexpr int SsimWindow = 11;
inline constexpr double SsimSigma = 1.5;

/// Structural similarity (Wang and others, 2004) of pictures \p Width pixels
/// wide with peak 1: K1 = 0.01, K2 = 0.03, a Gaussian window, zeros beyond the
/// border, the mean over all pixels and channels. 1 for equal pictures.
double ssim(const std::vector<double> &A, const std::vector<double> &B,
            std::size_t Width, std::size_t Channels);

/// Compares \p A and \p B, both \p Channels values a pixel, over the pixels
/// whose entry of \p Skip is 0 (all, where \p Skip is empty). A value that is
/// no finite number, on either side or both, makes PSNR minus infinity, MaxAbs
/// infinity and the pixel off.
Difference compare(const std::vector<double> &A, const std::vector<double> &B,
                   std::size_t Channels, const std::vector<uint8_t> &Skip = {});

/// PSNR with peak 255 of the clamped, rounded 8-bit values.
double psnr8Bit(const std::vector<float> &A, const std::vector<float> &B);
/// Of 8-bit values as they are.
double psnrOfBytes(const std::vector<uint8_t> &A,
                   const std::vector<uint8_t> &B);

/// How far gradients \p A are off from \p B: the difference's L2 norm relative
/// to that of \p B, or to \p Least if that is more. What is NaN in \p B is left
/// out; another NaN makes it NaN, which is within no limit.
double relativeL2(std::span<const double> A, std::span<const double> B,
                  double Least = 0);

} // namespace vorion::splat
