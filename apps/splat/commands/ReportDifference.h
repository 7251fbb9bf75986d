/// Comparison of two reports of a result.
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
  std::vector<ValueDifference> First; ///< the first few differences
};

/// The differences of \p Is from \p Was, except host times, the program, and
/// the names of output files.
ReportDifference differenceOf(const nlohmann::ordered_json &Was,
                              const nlohmann::ordered_json &Is);

} // namespace vorion::splat
