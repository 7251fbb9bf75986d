/// The HTML page of a sweep: one file that needs no other and no network.
#pragma once

#include "Sweep.h"

#include <string>
#include <string_view>

namespace vorion::splat {

/// page.html with page.js in it; @DATA@ stands where the measurements go.
std::string_view pageTemplate();

/// What the page is told besides the measurements.
struct PageHead {
  std::string Made;                  ///< a line: what made it
  double FloorDb;                    ///< to begin with
  std::vector<std::string> ChosenOn; ///< views that choose the recommended one
};

/// The page of \p Settings on all views, from the points' files.
Expected<std::string> pageOf(const SweepPlan &P, const PageHead &Head,
                             const std::vector<Setting> &Settings);

} // namespace vorion::splat
