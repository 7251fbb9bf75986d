/// Pictures beside their photographs: as files, and as a page.
#pragma once

#include "eval/Evaluation.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// scores.html with its script.
std::string_view scoreTemplate();

/// What a page is about.
struct ScorePage {
  std::string Scene;             ///< its name, for people
  std::vector<std::string> Made; ///< lines for the foot
};

/// The page of \p Scores, of the views \p Views in the same order.
Expected<std::string> scorePageOf(const ScorePage &P,
                                  const std::vector<JudgedView> &Views,
                                  const std::vector<ViewScore> &Scores);

/// The two files of a view called \p Name: PREFIX.NAME.drawn.png and
/// PREFIX.NAME.photo.png.
std::vector<std::string> pairFiles(const std::string &Prefix,
                                   const std::string &Name);

/// Writes the two files of each view.
Expected<Success> writePairFiles(const std::string &Prefix,
                                 const std::vector<JudgedView> &Views,
                                 const std::vector<ViewScore> &Scores);

} // namespace vorion::splat
