// What a camera that is no plain pinhole does: its lens, its shutter, and the
// points that stand for a Gaussian.
#pragma once

#include "lens_model.cl"
#if HAS_LENS
#include "lens.cl"
#if USE_ROLLING_SHUTTER
#include "rolling.cl"
#endif
#if USE_UNSCENTED
#include "unscented.cl"
#endif
#endif
