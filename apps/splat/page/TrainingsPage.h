/// The curves of trainings, and the page that compares them.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// trainings.html with its script.
std::string_view trainingsTemplate();

/// What curves.js draws of \p Report, a report of `splat train --json`: losses,
/// and pairs of iterations and numbers of Gaussians, PSNRs of held-out views in
/// dB, and times of an iteration on the machine in ms.
nlohmann::ordered_json curvesOf(const std::string &Name,
                                const nlohmann::ordered_json &Report);

/// A figure of two trainings, or a setting in which they differ.
struct TrainingChange {
  std::string Name;
  std::string A, B; ///< empty if unknown
};

/// The page of two \p Reports with the names \p Names, and the lines \p Made
/// for the foot.
std::string trainingsPageOf(const std::vector<std::string> &Names,
                            const std::vector<nlohmann::ordered_json> &Reports,
                            const std::vector<TrainingChange> &Changes,
                            const std::vector<std::string> &Made);

} // namespace vorion::splat
