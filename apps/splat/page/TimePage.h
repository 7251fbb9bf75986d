/// The page with the breakdown of the frame time of one run or two.
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
  /// The report of `splat render --time --json` for one view; its "heat_map" is
  /// shown if present.
  nlohmann::ordered_json Report;
  std::string Picture; ///< PNG; empty for none
};

/// The page of one run or two; \p Changes is the list of figures that
/// `splat compare --times --json` writes, or null. Errors: a report without the
/// time of a frame.
Expected<std::string> timePageOf(const std::vector<TimeRun> &Runs,
                                 nlohmann::ordered_json Changes = {});

} // namespace vorion::splat
