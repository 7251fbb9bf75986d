/// The definitions of all error metrics of pictures and gradients.
///
/// For numerics, PSNR has peak 1 and is computed on linear, unclamped floats
/// over all channels: -10 log10(mean squared error). It is infinite for equal
/// pictures. Non-finite values are unequal to everything, including themselves.
/// Against photographs, PSNR is computed on the 8-bit values of `toByte` (\c
/// psnr8Bit); the PSNR of a set is the mean over its pictures in dB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace vorion::splat {

/// Differences over the compared pixels.
struct Difference {
  std::size_t Pixels = 0; ///< compared
  double PsnrDb = 0;      ///< infinity for equal pictures or no pixel
  double MaxAbs = 0;      ///< largest absolute difference of a channel
  /// Pixels with a non-finite value in either picture.
  std::size_t NotFinite = 0;
  /// Fraction of pixels with a channel that differs by more than 1/255.
  double OffShare = 0;
};

/// Side of SSIM's window and its standard deviation, pixels.
inline constexpr int SsimWindow = 11;
inline constexpr double SsimSigma = 1.5;

/// Structural similarity (Wang and others, 2004) of pictures \p Width pixels
/// wide with peak 1: K1 = 0.01, K2 = 0.03, a Gaussian window, zero padding, the
/// mean over all pixels and channels. 1 for equal pictures.
double ssim(const std::vector<double> &A, const std::vector<double> &B,
            std::size_t Width, std::size_t Channels);

/// Weights of the scales of MS-SSIM, finest first, as published.
inline constexpr std::array<double, 5> MsSsimWeights{0.0448, 0.2856, 0.3001,
                                                     0.2363, 0.1333};
/// Minimum side for which the coarsest scale contains a window, px.
inline constexpr std::size_t MsSsimLeastSide = std::size_t{SsimWindow}
                                               << (MsSsimWeights.size() - 1);

/// Multi-scale SSIM (Wang and others, 2003) with the window and constants of
/// \c ssim: each scale is the previous one downsampled by a 2x2 box filter,
/// without a last odd row or column. Only windows inside the picture are used.
/// A negative mean is clamped to 0. Returns the mean of the channels; empty if
/// a side is shorter than \c MsSsimLeastSide.
std::optional<double> msSsim(const std::vector<double> &A,
                             const std::vector<double> &B, std::size_t Width,
                             std::size_t Channels);

/// Compares \p A and \p B, both \p Channels values a pixel, over the pixels
/// whose entry of \p Skip is 0 (all, where \p Skip is empty). A non-finite
/// value in either picture makes PSNR minus infinity, MaxAbs infinity and
/// counts the pixel as different.
Difference compare(const std::vector<double> &A, const std::vector<double> &B,
                   std::size_t Channels, const std::vector<uint8_t> &Skip = {});

/// PSNR with peak 255 of the clamped, rounded 8-bit values.
double psnr8Bit(const std::vector<float> &A, const std::vector<float> &B);
/// PSNR of 8-bit values.
double psnrOfBytes(const std::vector<uint8_t> &A,
                   const std::vector<uint8_t> &B);
/// The same over the pixels, of three bytes, with a nonzero entry in \p Counts;
/// over all if \p Counts is empty.
double psnrOfBytes(const std::vector<uint8_t> &A, const std::vector<uint8_t> &B,
                   const std::vector<uint8_t> &Counts);

/// Relative error of the gradients \p A: the L2 norm of the difference from \p
/// B divided by that of \p B, or by \p Least if that is larger. Entries that
/// are NaN in \p B are skipped; another NaN makes the result NaN, which exceeds
/// every limit.
double relativeL2(std::span<const double> A, std::span<const double> B,
                  double Least = 0);

} // namespace vorion::splat
