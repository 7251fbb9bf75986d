/// What somebody may have meant who wrote something else.
#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vorion {

/// How many characters must be added, left out or changed to turn \p A into
/// \p B.
inline std::size_t editDistance(std::string_view A, std::string_view B) {
  std::vector<std::size_t> Row(B.size() + 1);
  std::iota(Row.begin(), Row.end(), std::size_t{0});
  for (std::size_t I = 0; I < A.size(); ++I) {
    std::size_t Diagonal = std::exchange(Row[0], I + 1);
    for (std::size_t J = 0; J < B.size(); ++J) {
      const std::size_t Changed = Diagonal + (A[I] == B[J] ? 0 : 1);
      Diagonal = Row[J + 1];
      Row[J + 1] = std::min({Changed, Row[J] + 1, Diagonal + 1});
    }
  }
  return Row.back();
}

/// The first of the \p Known words that are most like \p Written; none if more
/// than a third of it would have to change.
inline std::optional<std::string>
nearest(std::string_view Written, const std::vector<std::string> &Known) {
  std::optional<std::string> Best;
  std::size_t Least = Written.size() / 3 + 1;
  for (const std::string &Word : Known)
    if (const std::size_t Distance = editDistance(Written, Word);
        Distance < Least) {
      Least = Distance;
      Best = Word;
    }
  return Best;
}

} // namespace vorion
