/// All camera models. What names a model, which tests alone do outside this
/// folder, includes Models.h.
#pragma once

#include "lens/LensModel.h"

#include <string>

namespace vorion::splat {

namespace lenses {

/// What a camera is of which nothing else is said.
extern const LensModel Pinhole;

std::span<const LensModel *const> all();

} // namespace lenses

/// The model that files call \p Name, in any case of letters, or null.
const LensModel *lensModelNamed(std::string_view Name);
/// Names of models, for messages: "A, B or C".
std::string knownLensModels();

/// \name The same by the names of nerfstudio's viewer
/// @{
const LensModel *lensModelOfViewer(std::string_view Name);
std::string knownViewerModels();
/// @}

} // namespace vorion::splat
