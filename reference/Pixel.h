/// The contributions to a pixel.
#pragma once

#include "Render.h"

#include <cstdint>
#include <vector>

namespace vorion::reference {

/// A Gaussian that a pixel blends, or a transparent surface.
template <typename Real> struct Contributor {
  int32_t Index = 0; ///< of the splat, or of the pixel's layer
  Real Alpha = 0;
  Real Weight = 0; ///< alpha times the transmittance in front of it
  bool IsLayer = false;
};

/// What is blended in pixel (\p X, \p Y), front to back, by the same
/// computation as \c blend with the same arguments. \p Behind: the surfaces in
/// this pixel, its only one; null for none. An opaque one is not in the result:
/// its weight is the transmittance behind the last.
template <typename Real>
std::vector<Contributor<Real>>
contributors(const std::vector<Splat<Real>> &Splats, int Width, int Height,
             const Options &O, int X, int Y,
             const Surface<Real> *Behind = nullptr);

/// The Gaussians of every pixel, rows from the top.
template <typename Real>
std::vector<std::vector<Contributor<Real>>>
contributorsOfAll(const std::vector<Splat<Real>> &Splats, int Width, int Height,
                  const Options &O);

} // namespace vorion::reference
