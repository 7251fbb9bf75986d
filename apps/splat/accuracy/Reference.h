/// The fp64 reference pictures, rendered once for each view and support, and
/// stored as files.
#pragma once

#include "accuracy/Sweep.h"

#include "io/Image.h"

#include <functional>
#include <string_view>

namespace vorion::splat {

/// Renders the picture for a point, unless it is stored with the same
/// provenance. The scene is read once. \p P must outlive the function; \p Log
/// is called for each picture.
std::function<Expected<Success>(const Point &)>
referenceMaker(const SweepPlan &P, std::function<void(std::string_view)> Log);

/// The reference picture for \p Of, made by referenceMaker().
Expected<ExactImage> referenceOf(const SweepPlan &P, const Point &Of);

} // namespace vorion::splat
