/// Suggestions for misspelt words ("did you mean").
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion {

/// The word of \p Known with the smallest Damerau-Levenshtein distance to \p
/// Word; the first of several. If none is near, the word of which \p Word, of
/// at least two letters, is a prefix, if that word is a prefix of all others
/// with this prefix; else empty. Empty, too, if \p Known contains \p Word.
std::string_view closestTo(std::string_view Word,
                           std::span<const std::string> Known);

/// The suggestion at the end of a message: "; did you mean front?", or empty if
/// none of \p Known, any range of strings, is near.
template <typename Range>
std::string didYouMean(std::string_view Word, const Range &Known) {
  const std::vector<std::string> Names(std::begin(Known), std::end(Known));
  const std::string_view Meant = closestTo(Word, Names);
  return Meant.empty() ? "" : "; did you mean " + std::string(Meant) + "?";
}

} // namespace vorion
