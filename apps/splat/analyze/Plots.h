/// The charts of an analysis.
#pragma once

#include "analyze/Analysis.h"
#include "page/Chart.h"

#include <map>
#include <string>

namespace vorion::splat {

/// `invocations`, `occlusion` and `lists`: pairs against tile size for every
/// support, occluded pixels against list depth and tiles against list length
/// for 16 and 64 pixels. \p What is part of the titles: scene and view.
std::map<std::string, Chart> chartsOf(const Analysis &A,
                                      const std::string &What);

} // namespace vorion::splat
