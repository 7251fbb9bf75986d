/// The charts of an analysis.
#pragma once

#include "analyze/Analysis.h"
#include "page/Chart.h"

#include <map>
#include <string>

namespace vorion::splat {

/// `invocations`, `occlusion` and `lists`: pairs against tile size for every
/// support, occluded pixels against list depth and tiles against list length
/// for 16 and 64 pixels.
std::map<std::string, Chart> chartsOf(const Analysis &A);

} // namespace vorion::splat
