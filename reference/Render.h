/// Blending: the picture, and which of its pixels are doubtful.
#pragma once

#include "Tiles.h"

#include <cstdint>
#include <vector>

namespace vorion::reference {

/// Reasons for which a pixel is doubtful: a correct fp32 implementation may
/// decide differently there. Bits of \c Picture::Doubts.
enum Doubt : uint8_t {
  /// A decision at alpha = 1/255, at the transmittance cut-off or at the border
  /// of the support is within \c DoubtBand of its threshold.
  DoubtThreshold = 1,
  /// A visible Gaussian has a z so near the midpoint of two fp32 numbers (\c
  /// Splat::DepthSlack) that it may be rounded to either, with a different
  /// blend order.
  DoubtOrder = 2,
};

/// Relative width of the doubtful band around a threshold.
inline constexpr double DoubtBand = 1e-5;

/// A rendered picture, rows from the top.
template <typename Real> struct Picture {
  int Width = 0, Height = 0;
  std::vector<glm::vec<3, Real>> Render; ///< with background, unclamped
  std::vector<Real> Transmittance;       ///< final; alpha is 1 minus this
  std::vector<uint8_t> Doubts;           ///< of \c Doubt
  /// Last Gaussian that was blended, -1 if none.
  std::vector<int32_t> Last;
  /// The Gaussian at which the pixel was saturated, -1 if it was not.
  std::vector<int32_t> Stop;

  /// Blended (Gaussian, pixel) pairs.
  uint64_t Blends = 0;
  /// List entries that pixels visited, including the saturating one.
  uint64_t Walked = 0;
  /// Saturated pixels.
  uint64_t Saturated = 0;

  double doubtfulShare() const;
};

/// Blends \p Splats, the result of \c project with the same \p O. In fp32 every
/// operation is rounded as docs/abi.md states for the rasterizer, with a
/// correctly rounded exponential. \c Walked counts entries of the lists of \c
/// tileLists for the support and tile size of \p O.
template <typename Real>
Picture<Real> blend(const std::vector<Splat<Real>> &Splats, int Width,
                    int Height, const Options &O);

/// \c project followed by \c blend.
template <typename Real>
Picture<Real> render(const Gaussians<Real> &G, const Camera<Real> &C,
                     const Options &O);

} // namespace vorion::reference
