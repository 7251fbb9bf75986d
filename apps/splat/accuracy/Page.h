/// The HTML pages of sweeps, each in one file that needs no network.
#pragma once

#include "accuracy/HostTime.h"
#include "accuracy/Sweep.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// page.html and train.html with their scripts; @DATA@ is the placeholder of
/// the measurements.
std::string_view pageTemplate();
std::string_view trainPageTemplate();

/// The data of the page besides the measurements.
struct PageHead {
  std::string Verdict;        ///< the result, one sentence
  std::vector<HostTime> Host; ///< may be empty
  std::string Made;           ///< one line of provenance
  double FloorDb;             ///< initial minimum PSNR
  /// Views by which the recommended setting is selected.
  std::vector<const Camera *> ChosenOn;
};

/// The page of \p Settings, the default first. All points must be measured.
Expected<std::string> pageOf(const SweepPlan &P, PointStore &Kept,
                             const PageHead &Head,
                             const std::vector<Setting> &Settings);

/// The page of trainResults() (TrainSweep.h); \p Made: lines of the footer.
std::string trainPageOf(const nlohmann::ordered_json &Results,
                        const std::vector<std::string> &Made);

} // namespace vorion::splat
