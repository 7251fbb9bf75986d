/// A camera in the form that the kernels read.
#pragma once

#include "io/Cameras.h"
#include "picture/Layout.h"
#include "picture/Options.h"

namespace vorion::splat {

/// \p C rounded to fp32 once, with the Jacobian's limits of \p Options' rules
/// and the tiles of its path.
splat_view makeView(const Camera &C, const RenderOptions &Options);

} // namespace vorion::splat
