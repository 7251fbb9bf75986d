/// What the order of Gaussians does to a picture. Centres' depths give one
/// order for all pixels, which changes as a whole when the camera moves
/// ("popping"); each pixel's own ray would give another.
#pragma once

#include "Render.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vorion::reference {

/// The depth by which Gaussian \p Index is ordered in pixel (\p X, \p Y).
using PixelDepth = std::function<double(std::size_t Index, int X, int Y)>;

/// A picture in another order, and what the order moved.
struct Reordered {
  /// As \c Picture has them.
  std::vector<glm::dvec3> Render;
  std::vector<double> Transmittance;
  /// Over all pixels, pairs of Gaussians that the pixel blends by the depths of
  /// centres, and how many of them the other order turns round.
  uint64_t Pairs = 0, Turned = 0;
};

/// Blends \p Splats, which \c project made with the same \p O, each pixel's by
/// \p Depth, equal ones by number.
Reordered blendInOrder(const std::vector<Splat<double>> &Splats, int Width,
                       int Height, const Options &O, const PixelDepth &Depth);

/// The depth at which a pixel's ray is deepest in a Gaussian, as StopThePop has
/// it (Radl et al. 2024): t = r' S r0 / r' S r for the ray t r, the mean r0 and
/// the inverse covariance S in the axes of \p C, a pinhole. \p G must outlive
/// it.
PixelDepth depthAlongRay(const Gaussians<double> &G, const Camera<double> &C);

} // namespace vorion::reference
