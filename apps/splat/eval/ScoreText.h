/// Scores of views as text, CSV and JSON.
#pragma once

#include "eval/Evaluation.h"

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vorion::splat {

/// The reason why reports have no LPIPS.
inline constexpr const char *NoLpips =
    "LPIPS is not computed: it needs the weights of trained networks, which "
    "are not part of this program";

/// A line per view, and the means.
std::string scoreTable(const std::vector<ViewScore> &Scores);

/// RFC 4180 with a header line, without the mean.
std::string scoreCsv(const std::vector<ViewScore> &Scores);

/// "views" and their means; null for missing values and for the infinite PSNR
/// of equal pictures.
nlohmann::ordered_json scoreJson(const std::vector<ViewScore> &Scores);

} // namespace vorion::splat
