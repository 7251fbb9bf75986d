/// The answer of `splat accuracy` in one sentence.
#pragma once

#include "accuracy/Front.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// What the exponential unit costs in cycles, area and energy, by those of
/// \p All, the default first, that change it alone. Where none does, what the
/// fastest setting with at least \p FloorDb saves. \p On: the machine and its
/// clock.
std::string verdictOf(const std::vector<Candidate> &All, double FloorDb,
                      const std::string &On);

} // namespace vorion::splat
