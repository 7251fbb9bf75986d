/// Cameras for whose places on the picture fp32 has too few digits.
#pragma once

#include "Build.h"

namespace vorion::test {

/// A pinhole of 96x64 px with a focal length of 400,000 px, 80 units from what
/// \c smallOnPicture gives it.
splat::Camera longView();

/// A pinhole of 16,384x16 px.
splat::Camera wideView();

/// \p Count Gaussians of half a pixel to three, anywhere on the picture of \p
/// C.
splat::Scene smallOnPicture(const splat::Camera &C, uint32_t Count,
                            uint32_t Seed);

} // namespace vorion::test
