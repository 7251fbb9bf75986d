/// Cameras that are no pinholes, for the catalogue's cases.
#pragma once

#include "Build.h"
#include "lens/Models.h"

namespace vorion::test {

/// The front view of \p Width by \p Height through a lens of a focal length of
/// 50 px.
splat::Camera lensView(const splat::LensModel *M,
                       splat::LensCoefficients K = {}, int Width = 64,
                       int Height = 48);

/// Coefficients of both signs in every place that the model has; small ones of
/// a model that this file does not know.
splat::LensCoefficients someCoefficients(const splat::LensModel *M);

/// A turned camera for \c pointingNeedles.
splat::Camera needleView(const splat::LensModel *M);

/// Needles as long as 1,000 to 6,000 px, of which the picture of \p C has half
/// a pixel to three, because they point at the camera.
splat::Scene pointingNeedles(const splat::Camera &C, uint32_t Seed);

/// \p Count Gaussians all around the camera, none so near that it is in them.
splat::Scene allAround(uint32_t Count, uint32_t Seed, double Scale = 0.15);

} // namespace vorion::test
