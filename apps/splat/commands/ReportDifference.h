/// Whether two reports say the same of a result.
#pragma once

#include <cstddef>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace vorion::splat {

/// "counts.pairs": "12", was "10"; "missing" where there is none.
struct ValueDifference {
  std::string Path, Is, Was;
};

struct ReportDifference {
  std::size_t Compared = 0, Differing = 0;
  std::vector<ValueDifference> First; ///< the first few that differ
};

/// In what \p Is differs from \p Was. Times of this computer, the program, and
/// the names of files that were written are no part of a result.
ReportDifference differenceOf(const nlohmann::ordered_json &Was,
                              const nlohmann::ordered_json &Is);

} // namespace vorion::splat
