/// Conversion of scenes and options for the reference renderer.
#pragma once

#include "io/Cameras.h"
#include "mesh/Mesh.h"
#include "picture/Options.h"
#include "reference/Mesh.h"
#include "reference/Render.h"
#include "reference/Types.h"
#include "scene/Drawing.h"
#include "scene/Scene.h"

#include <array>
#include <optional>

namespace vorion::splat {

/// \p S, activated as `Activation.h` states.
template <typename Real> reference::Gaussians<Real> toReference(const Scene &S);

/// \p C in precision \p Real, rounded once from doubles as the device gets it.
template <typename Real> reference::Camera<Real> toReference(const Camera &C);

/// \p M, on which a light shines along \p Light if there is one.
reference::Mesh toReference(const Mesh &M,
                            const std::optional<std::array<float, 3>> &Light);

reference::Rules toReference(Rules R);
reference::Support toReference(Support S);

/// The options of \p O that affect a picture's bits, with values as on the
/// device.
reference::Options toReference(const RenderOptions &O);

/// The defaults, for a scene with the rendering mode \p D.
reference::Options toReference(const Drawing &D);

} // namespace vorion::splat
