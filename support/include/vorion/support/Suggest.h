/// "Did you mean": what a mistyped word was probably meant to be.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace vorion {

/// The word of \p Known that differs least from \p Word by letters left out,
/// put in, changed or swapped with their neighbour; of several, the first. If
/// none is near, the one that \p Word, of two letters or more, begins, and that
/// begins all others that it begins; else empty. Nobody is told what they
/// wrote: empty, too, if \p Known has it.
std::string_view closestTo(std::string_view Word,
                           std::span<const std::string> Known);

/// How a message that has named what was expected ends: "; did you mean
/// front?", or empty if none of \p Known, any range of texts, is near.
template <typename Range>
std::string didYouMean(std::string_view Word, const Range &Known) {
  const std::vector<std::string> Names(std::begin(Known), std::end(Known));
  const std::string_view Meant = closestTo(Word, Names);
  return Meant.empty() ? "" : "; did you mean " + std::string(Meant) + "?";
}

} // namespace vorion
