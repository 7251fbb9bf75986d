/// The project's only definitions of the differences of pictures and gradients.
///
/// For numerics, PSNR has peak 1 and is taken on linear, unclamped floats over
/// all channels: -10 log10(mean squared difference). Equal pictures are at
/// infinity. What is no finite number is no picture: it equals nothing, itself
/// neither. Against photographs, take it on the 8-bit values that `toByte`
/// gives (\c psnr8Bit); a set's figure is the mean of its pictures' dB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

/// Shares of the scales of MS-SSIM, the finest first, as published.
inline constexpr std::array<double, 5> MsSsimWeights{0.0448, 0.2856, 0.3001,
                                                     0.2363, 0.1333};
/// The shortest side for which the coarsest scale still holds a window, px.
inline constexpr std::size_t MsSsimLeastSide = std::size_t{SsimWindow}
                                               << (MsSsimWeights.size() - 1);

/// Multi-scale SSIM (Wang and others, 2003) with the window and constants of
/// \c ssim: a scale halves the one before by the mean of 2x2 pixels, without a
/// last odd row or column. Only windows inside the picture count. A mean below
/// 0 counts as 0. The mean of the channels; nothing where a side is shorter
/// than \c MsSsimLeastSide.
std::optional<double> msSsim(const std::vector<double> &A,
                             const std::vector<double> &B, std::size_t Width,
                             std::size_t Channels);

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
/// The same over the pixels, of three bytes, whose entry of \p Counts is not 0;
/// all, where \p Counts is empty.
double psnrOfBytes(const std::vector<uint8_t> &A, const std::vector<uint8_t> &B,
                   const std::vector<uint8_t> &Counts);

/// How far gradients \p A are off from \p B: the difference's L2 norm relative
/// to that of \p B, or to \p Least if that is more. What is NaN in \p B is left
/// out; another NaN makes it NaN, which is within no limit.
double relativeL2(std::span<const double> A, std::span<const double> B,
                  double Least = 0);

} // namespace vorion::splat
