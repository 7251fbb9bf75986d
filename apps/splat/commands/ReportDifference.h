/// Whether two reports say the same of a result.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

struct ReportDifference {
  std::size_t Compared = 0, Differing = 0;
  /// "counts.pairs: 12, was 10", the first few of them.
  std::vector<std::string> Lines;
};

/// In what \p Is differs from \p Was. Times of this computer, the program, and
/// the names of files that were written are no part of a result.
ReportDifference differenceOf(const nlohmann::ordered_json &Was,
                              const nlohmann::ordered_json &Is);

} // namespace vorion::splat
