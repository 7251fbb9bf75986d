/// The contributions to a pixel.
#pragma once

#include "Render.h"

#include <cstdint>
#include <vector>

namespace vorion::reference {

/// A Gaussian that a pixel blends.
template <typename Real> struct Contributor {
  int32_t Index = 0; ///< of the splat
  Real Alpha = 0;
  Real Weight = 0; ///< alpha times the transmittance in front of it
};

/// The Gaussians blended in pixel (\p X, \p Y), front to back, by the same
/// computation as \c blend with the same arguments.
template <typename Real>
std::vector<Contributor<Real>>
contributors(const std::vector<Splat<Real>> &Splats, int Width, int Height,
             const Options &O, int X, int Y);

/// The Gaussians of every pixel, rows from the top.
template <typename Real>
std::vector<std::vector<Contributor<Real>>>
contributorsOfAll(const std::vector<Splat<Real>> &Splats, int Width, int Height,
                  const Options &O);

} // namespace vorion::reference
