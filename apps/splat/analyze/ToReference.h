/// From what the readers give to what the reference renders.
#pragma once

#include "io/Cameras.h"
#include "reference/Types.h"
#include "scene/Scene.h"

namespace vorion::splat {

/// \p S, activated as `Activation.h` states.
template <typename Real> reference::Gaussians<Real> toReference(const Scene &S);

/// \p C in precision \p Real, rounded once from doubles as the device gets it.
template <typename Real> reference::Camera<Real> toReference(const Camera &C);

} // namespace vorion::splat
