/// Cameras that are no pinholes, for the catalogue's cases.
#pragma once

#include "Build.h"

namespace vorion::test {

/// The front view of \p Width by \p Height through a lens of a focal length of
/// 50 px.
splat::Camera lensView(splat::LensModel M, std::array<double, 12> K = {},
                       int Width = 64, int Height = 48);

/// Coefficients of both signs in every place that the model has.
std::array<double, 12> someCoefficients(splat::LensModel M);

/// \p Count Gaussians all around the camera, none so near that it is in them.
splat::Scene allAround(uint32_t Count, uint32_t Seed, double Scale = 0.15);

} // namespace vorion::test
