/// The HTML pages of sweeps: each one file that needs no other and no network.
#pragma once

#include "accuracy/HostTime.h"
#include "accuracy/Sweep.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// page.html and train.html with their scripts; @DATA@ stands where the
/// measurements go.
std::string_view pageTemplate();
std::string_view trainPageTemplate();

/// What the page is told besides the measurements.
struct PageHead {
  std::string Verdict;        ///< the answer, one sentence
  std::vector<HostTime> Host; ///< may be empty
  std::string Made;           ///< a line: what was measured
  double FloorDb;             ///< to begin with
  /// Views that choose the recommended one.
  std::vector<const Camera *> ChosenOn;
};

/// The page of \p Settings, the default first, on all views, all of which are
/// measured.
Expected<std::string> pageOf(const SweepPlan &P, PointStore &Kept,
                             const PageHead &Head,
                             const std::vector<Setting> &Settings);

/// The page of trainResults() (TrainSweep.h); \p Made: lines for the foot.
std::string trainPageOf(const nlohmann::ordered_json &Results,
                        const std::vector<std::string> &Made);

} // namespace vorion::splat
