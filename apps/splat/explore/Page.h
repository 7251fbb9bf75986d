/// The page and the JSON of `splat explore`.
#pragma once

#include "explore/Trials.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// page.html with its script; @DATA@ is the placeholder of the results.
std::string_view explorePage();

/// The results of a study.
struct Findings {
  std::vector<Measured> Small; ///< all machines, unless all were measured at
                               ///< full size
  /// The base first. Machines that were rejected on small views are skipped.
  std::vector<Measured> Whole;
  /// Each single change of the base: from Whole, or from Small if it was
  /// rejected.
  std::vector<Measured> Alone;
  /// Indices in Whole of the random machines by which both sizes are compared.
  std::vector<std::size_t> Checked;
  /// By kind of work, in the order of AllWork.
  std::array<std::vector<Interaction>, AllWork.size()> Pairs;
};

/// The file explore.json, without its head.
nlohmann::ordered_json resultsOf(const ExplorePlan &P, const Findings &F);

/// The page of the results; \p Made: lines of the footer.
std::string explorePageOf(const nlohmann::ordered_json &Results,
                          const std::vector<std::string> &Made);

/// For the terminal.
std::string textOf(const nlohmann::ordered_json &Results);

} // namespace vorion::splat
