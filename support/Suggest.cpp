#include "vorion/support/Suggest.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace vorion {
namespace {

/// Letters to leave out, put in, change or swap. Both words are short.
std::size_t distance(std::string_view A, std::string_view B) {
  std::vector<std::vector<std::size_t>> D(
      A.size() + 1, std::vector<std::size_t>(B.size() + 1));
  for (std::size_t I = 0; I <= A.size(); ++I)
    D[I][0] = I;
  for (std::size_t J = 0; J <= B.size(); ++J)
    D[0][J] = J;
  for (std::size_t I = 1; I <= A.size(); ++I)
    for (std::size_t J = 1; J <= B.size(); ++J) {
      const bool Differ = A[I - 1] != B[J - 1];
      D[I][J] = std::min(
          {D[I - 1][J] + 1, D[I][J - 1] + 1, D[I - 1][J - 1] + Differ});
      if (I > 1 && J > 1 && A[I - 1] == B[J - 2] && A[I - 2] == B[J - 1])
        D[I][J] = std::min(D[I][J], D[I - 2][J - 2] + 1);
    }
  return D[A.size()][B.size()];
}

/// The word of \p Known that begins with \p Word, if there is one alone or all
/// others begin with it: "table" of "table", "table32".
std::string_view onlyOneBegunBy(std::string_view Word,
                                std::span<const std::string> Known) {
  constexpr std::size_t Fewest = 2; // letters; one says too little
  const std::size_t First = Word.find_first_not_of('-');
  if (First == std::string_view::npos || Word.size() - First < Fewest)
    return {};
  std::string_view Shortest;
  for (const std::string &K : Known)
    if (K.starts_with(Word) && (Shortest.empty() || K.size() < Shortest.size()))
      Shortest = K;
  const bool IsOne = std::ranges::all_of(Known, [&](const std::string &K) {
    return !K.starts_with(Word) || K.starts_with(Shortest);
  });
  return IsOne ? Shortest : std::string_view();
}

} // namespace

std::string_view closestTo(std::string_view Word,
                           std::span<const std::string> Known) {
  constexpr std::size_t Longest = 64; // no option of ours is as long
  if (Word.size() > Longest)
    return {};
  // A third of the letters wrong is no slip any more.
  std::size_t Least = Word.size() / 3 + 1;
  std::string_view Found;
  for (const std::string &K : Known)
    if (const std::size_t D = distance(Word, K); D < Least) {
      if (D == 0)
        return {};
      Least = D;
      Found = K;
    }
  return Found.empty() ? onlyOneBegunBy(Word, Known) : Found;
}

} // namespace vorion
