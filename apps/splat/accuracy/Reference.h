/// The fp64 pictures that settings are judged by: rendered once a view and
/// support, kept as files.
#pragma once

#include "accuracy/Sweep.h"

#include "io/Image.h"

#include <functional>
#include <string_view>

namespace vorion::splat {

/// Renders the picture for a point, unless it is there, made from the same. The
/// scene is read once for all points. \p P must live as long; \p Log gets a
/// line for each picture.
std::function<Expected<Success>(const Point &)>
referenceMaker(const SweepPlan &P, std::function<void(std::string_view)> Log);

/// The picture for \p Of, which referenceMaker() has made.
Expected<ExactImage> referenceOf(const SweepPlan &P, const Point &Of);

} // namespace vorion::splat
