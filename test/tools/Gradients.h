/// The gradients that a device's are judged by: the reference's for a fixture,
/// with the loss left out where fp32 may rightly decide differently.
#pragma once

#include "Fixture.h"
#include "reference/Backward.h"
#include "scene/Scene.h"

#include <string>

namespace vorion::test {

/// The loss of \p F as the reference takes it.
reference::Upstream upstreamOf(const Fixture &F);

/// What `splat gradients` is given and judged by.
struct GradientFiles {
  splat::Npz Upstream; ///< in_v_render, in_v_alpha
  /// f64_g_* and f64_h_*. Beside an array NAME, `limit_NAME`: twice the error
  /// of the fixture's own fp32 result, if it has one (for a sum, of the
  /// gradient that follows from it); and `norm_NAME`: what its error is
  /// relative to.
  splat::Npz Expected;
};

/// Both without the pixels that are doubtful in \p Doubts.
GradientFiles gradientsOf(const Fixture &F, const std::vector<uint8_t> &Doubts);

/// The same of a view of \p S along rays, with the pixels' gradients \p U,
/// whose doubtful pixels become 0.
GradientFiles gradientsAlongRays(const splat::Scene &S,
                                 const reference::Camera<double> &C,
                                 const reference::Options &O,
                                 reference::Upstream U);

/// sqrt of the sum of squares, NaNs left out.
double norm(const std::vector<double> &V);

} // namespace vorion::test
