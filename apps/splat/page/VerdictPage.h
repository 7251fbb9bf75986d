/// The page of an answer: one sentence, then the supporting pictures and
/// tables.
#pragma once

#include "page/Chart.h"

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::splat {

/// verdict.html with its script; @DATA@ stands where the answer goes.
std::string_view verdictTemplate();

struct PagePicture {
  std::string Caption;
  std::string Png; ///< the file's bytes
};

struct PagePictures {
  std::string Title, Note;
  std::vector<PagePicture> Pictures; ///< beside each other
};

/// An answer as text, JSON and page.
struct AnswerTable {
  std::string Title;
  std::string Note; ///< may be empty
  std::vector<std::string> Columns;
  std::vector<std::vector<std::string>> Rows; ///< as many cells as columns
};

/// Text for a terminal: the first and the last column are left-aligned, the
/// others right-aligned.
std::string toString(const AnswerTable &T);

struct VerdictPage {
  std::string Heading, Verdict;
  std::vector<Chart> Charts; ///< of places
  std::vector<PagePictures> Pictures;
  std::vector<AnswerTable> Tables;
  std::vector<std::string> Made; ///< lines for the foot
};

std::string verdictPageOf(const VerdictPage &P);

} // namespace vorion::splat
