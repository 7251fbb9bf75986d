/// All camera models. Code that names a model includes Models.h; outside this
/// folder, only tests do.
#pragma once

#include "lens/LensModel.h"

#include <string>

namespace vorion::splat {

namespace lenses {

/// The default camera model.
extern const LensModel Pinhole;

std::span<const LensModel *const> all();

} // namespace lenses

/// The model with the name \p Name in files (not case-sensitive), or null.
const LensModel *lensModelNamed(std::string_view Name);
/// Names of models, for messages: "A, B or C".
std::string knownLensModels();

/// \name The same for names of nerfstudio's viewer
/// @{
const LensModel *lensModelOfViewer(std::string_view Name);
std::string knownViewerModels();
/// @}

} // namespace vorion::splat
