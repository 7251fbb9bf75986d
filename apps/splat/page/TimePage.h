/// The page that shows where the time of a frame goes, of one run or of two.
#pragma once

#include "vorion/support/Expected.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// time.html with its script.
std::string_view timeTemplate();

/// A run that the page shows.
struct TimeRun {
  std::string Name; ///< of the file, for people
  /// What `splat render --json` wrote with the clock on, for one view; its
  /// "heat_map" is shown where it has one.
  nlohmann::ordered_json Report;
  std::string Picture; ///< PNG; empty for none
};

/// The page of one run or two; \p Changes is the list of figures that
/// `splat compare --times --json` writes, or null. Errors: a report without the
/// time of a frame.
Expected<std::string> timePageOf(const std::vector<TimeRun> &Runs,
                                 nlohmann::ordered_json Changes = {});

} // namespace vorion::splat
