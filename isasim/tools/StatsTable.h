/// The counters of a run for people.
#pragma once

#include "vorion/isasim/Result.h"

#include <string>

namespace vorion::isasim {

/// A line a counter, totals only.
std::string statsTable(const RunResult &R);

} // namespace vorion::isasim
