/// The page and the JSON of `splat explore`.
#pragma once

#include "explore/Trials.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// page.html with its script; @DATA@ stands where the results go.
std::string_view explorePage();

/// All that a study found.
struct Findings {
  std::vector<Measured> Small; ///< all machines, unless they were judged whole
  /// The base first. Machines that cannot be on small views are not tried.
  std::vector<Measured> Whole;
  /// Each change of the base alone: of Whole, or of Small if it cannot be.
  std::vector<Measured> Alone;
  /// Of Whole: machines drawn at random, by which both sizes are compared.
  std::vector<std::size_t> Checked;
  /// By kind of work, in the order of AllWork.
  std::array<std::vector<Interaction>, AllWork.size()> Pairs;
};

/// The file explore.json, without its head.
nlohmann::ordered_json resultsOf(const ExplorePlan &P, const Findings &F);

/// The page of these; \p Made: lines for the foot.
std::string explorePageOf(const nlohmann::ordered_json &Results,
                          const std::vector<std::string> &Made);

/// For the terminal.
std::string textOf(const nlohmann::ordered_json &Results);

} // namespace vorion::splat
