/// The result of `splat accuracy` in one sentence.
#pragma once

#include "accuracy/Front.h"

#include <string>
#include <vector>

namespace vorion::splat {

/// The cost of the exponential unit in cycles, area and energy, from the
/// candidates of \p All that change only this knob; the default is the first.
/// Without such candidates, the saving of the fastest setting with at least \p
/// FloorDb. \p On: the machine and its clock.
std::string verdictOf(const std::vector<Candidate> &All, double FloorDb,
                      const std::string &On);

} // namespace vorion::splat
