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
  /// blend order, or on either side of a surface.
  DoubtOrder = 2,
  /// Another triangle of a surface, or another texel, may be seen.
  DoubtSurface = 4,
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

/// A transparent surface in a pixel. It is in front of Gaussians that have its
/// depth or a larger one, in the bits that order them.
template <typename Real> struct Layer {
  double Depth; ///< along the camera's axis
  glm::vec<3, Real> Color;
  Real Alpha;
  double Slack = 0; ///< by how much a machine's depth may differ
};

/// An opaque surface in the pixels of a picture, rows from the top, and
/// transparent ones in front of it. It hides what has its depth or a larger
/// one, in the bits that order Gaussians.
template <typename Real> struct Surface {
  std::vector<double> Depths; ///< along the camera's axis; infinite: none
  std::vector<glm::vec<3, Real>> Colors;
  /// By how much a machine's depth may differ; empty: not at all.
  std::vector<double> Slack;
  std::vector<bool> Doubtful; ///< pixels that show DoubtSurface; may be empty
  /// Of each pixel, the nearest first; empty if no pixel has any. The
  /// transmittance cut-off does not apply to them.
  std::vector<std::vector<Layer<Real>>> Layers;
};

/// Blends \p Splats, the result of \c project with the same \p O. In fp32 every
/// operation is rounded as docs/abi.md states for the rasterizer, with a
/// correctly rounded exponential. \c Walked counts entries of the lists of \c
/// tileLists for the support and tile size of \p O. \p Behind: a surface
/// that takes the background's place where it is; null for none.
template <typename Real>
Picture<Real> blend(const std::vector<Splat<Real>> &Splats, int Width,
                    int Height, const Options &O,
                    const Surface<Real> *Behind = nullptr);

/// \c project followed by \c blend.
template <typename Real>
Picture<Real> render(const Gaussians<Real> &G, const Camera<Real> &C,
                     const Options &O, const Surface<Real> *Behind = nullptr);

} // namespace vorion::reference
