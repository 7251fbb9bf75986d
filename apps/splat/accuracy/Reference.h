/// The fp64 pictures that settings are judged by: rendered once a view and
/// support, kept as files.
#pragma once

#include "accuracy/Sweep.h"

#include "io/Image.h"

namespace vorion::splat {

/// Renders those of \p Points that are not there, made from the same.
Expected<Success>
makeReferences(const SweepPlan &P, const std::vector<Point> &Points,
               const std::function<void(std::string_view)> &Log);

/// The picture for \p Of, which makeReferences has made.
Expected<ExactImage> referenceOf(const SweepPlan &P, const Point &Of);

} // namespace vorion::splat
