/// Scores of views for people and for programs.
#pragma once

#include "eval/Evaluation.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// Why LPIPS is in no report.
inline constexpr const char *NoLpips =
    "LPIPS is not computed: it needs the weights of trained networks, which "
    "are not part of this program";

/// A line a view, and the means.
std::string scoreTable(const std::vector<ViewScore> &Scores);

/// RFC 4180, with a line of names; the mean is no part of it.
std::string scoreCsv(const std::vector<ViewScore> &Scores);

/// "views" and their means; null stands for what is not there, and for the PSNR
/// of equal pictures, which is infinite.
nlohmann::ordered_json scoreJson(const std::vector<ViewScore> &Scores);

} // namespace vorion::splat
