/// Between fixtures, what the readers give, and what the reference renders;
/// apps/splat/analyze/ToReference.h has the rest.
#pragma once

#include "Fixture.h"
#include "analyze/ToReference.h"
#include "io/Cameras.h"
#include "io/Npz.h"
#include "reference/Render.h"
#include "scene/Activation.h"
#include "scene/Scene.h"

#include <string>
#include <utility>
#include <vector>

namespace vorion::test {

/// \p G and \p C in fp32, each number rounded once.
reference::Gaussians<float> toSingle(const reference::Gaussians<double> &G);
reference::Camera<float> toSingle(const reference::Camera<double> &C);

/// The parameters of \p F as a scene stores them: logarithms and logits in
/// fp32, direct colours as the constant spherical harmonic. An opacity of 1
/// becomes the logit that rounds back to it.
splat::Scene sceneOf(const Fixture &F);

/// The view of \p F, named "view". A fixture's rotation is one to fp32's
/// precision only; the position is such that R (p - position) is its R p + t.
splat::Camera cameraOf(const Fixture &F);

/// `render` (H, W, 3), `alpha`, `last`, and the booleans `mask_threshold` and
/// `mask_order`, in the precision of the picture.
template <typename Real> splat::Npz toNpz(const reference::Picture<Real> &P);

/// The pairs as `splat render --pairs` writes them: `tile`, `depth_bits`
/// and `index`, sorted by tile and depth.
template <typename Real>
splat::Npz toNpz(const reference::TileLists &T,
                 const std::vector<reference::Splat<Real>> &Splats);

/// The channels of \p P one after the other.
template <typename Real>
std::vector<double> renderOf(const reference::Picture<Real> &P);

} // namespace vorion::test
