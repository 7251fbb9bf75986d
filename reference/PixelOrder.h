/// The effect of the blend order on a picture. Depths of centres give one order
/// for all pixels, which changes globally when the camera moves ("popping");
/// depths along each pixel's ray give another.
#pragma once

#include "Render.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace vorion::reference {

/// The depth by which Gaussian \p Index is ordered in pixel (\p X, \p Y).
using PixelDepth = std::function<double(std::size_t Index, int X, int Y)>;

/// A picture with another blend order, and the number of changes.
struct Reordered {
  /// As in \c Picture.
  std::vector<glm::dvec3> Render;
  std::vector<double> Transmittance;
  /// Over all pixels, pairs of Gaussians that the pixel blends by the depths of
  /// centres, and the number of them that the other order inverts.
  uint64_t Pairs = 0, Turned = 0;
};

/// Blends \p Splats, the result of \c project with the same \p O, in each pixel
/// in the order of \p Depth, ties by index. \p Behind: a surface, as of \c
/// blend, whose depths are compared with these; null for none.
Reordered blendInOrder(const std::vector<Splat<double>> &Splats, int Width,
                       int Height, const Options &O, const PixelDepth &Depth,
                       const Surface<double> *Behind = nullptr);

/// The depth at which a pixel's ray is deepest in a Gaussian, as StopThePop has
/// it (Radl et al. 2024): t = r' S r0 / r' S r for the ray t r, the mean r0 and
/// the inverse covariance S in the axes of \p C, a pinhole. \p G must outlive
/// it.
PixelDepth depthAlongRay(const Gaussians<double> &G, const Camera<double> &C);

} // namespace vorion::reference
