/// The records of the camera models by name.
#pragma once

#include "lens/LensModel.h"

namespace vorion::splat::lenses {

#define VORION_LENS(Name) extern const LensModel Name;
#include "reference/lens/Lenses.def"

} // namespace vorion::splat::lenses
