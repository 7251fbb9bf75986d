/// Pictures and their photographs: as files, and as a page.
#pragma once

#include "eval/Evaluation.h"

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// scores.html with its script.
std::string_view scoreTemplate();

/// Headings of a page.
struct ScorePage {
  std::string Scene;             ///< its name, for people
  std::vector<std::string> Made; ///< lines for the foot
  /// Of the training (page/TrainingsPage.h); null if there was none.
  nlohmann::ordered_json Training = nullptr;
};

/// The page of \p Scores, of the views \p Views in the same order.
Expected<std::string> scorePageOf(const ScorePage &P,
                                  const std::vector<JudgedView> &Views,
                                  const std::vector<ViewScore> &Scores);

/// Writes two files of each view: PREFIX.NAME.drawn.png and
/// PREFIX.NAME.photo.png. If several views have the same NAME (a/b.png,
/// a_b.jpg), the second is NAME-2, and so on.
Expected<Success> writePairFiles(const std::string &Prefix,
                                 const std::vector<JudgedView> &Views,
                                 const std::vector<ViewScore> &Scores);

} // namespace vorion::splat
