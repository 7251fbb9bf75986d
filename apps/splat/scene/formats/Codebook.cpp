#include "scene/formats/Codebook.h"

#include <algorithm>
#include <cassert>
#include <queue>
#include <span>
#include <utility>

namespace vorion::splat {

std::vector<double> codebookOf(std::vector<float> Values) {
  constexpr std::size_t Size = 256;
  assert(!Values.empty());
  std::sort(Values.begin(), Values.end());
  std::vector<float> Different = Values;
  Different.erase(std::unique(Different.begin(), Different.end()),
                  Different.end());
  std::vector<double> Book(Size, Different.back());
  if (Different.size() <= Size) {
    std::copy(Different.begin(), Different.end(), Book.begin());
    return Book;
  }
  // Sums of the first values, so that a group's mean costs two of them.
  std::vector<double> Sums(Values.size() + 1);
  for (std::size_t I = 0; I < Values.size(); ++I)
    Sums[I + 1] = Sums[I] + Values[I];
  // Half by the quantiles and half by even steps: so rare ones get near, too.
  const double Low = Values.front(), High = Values.back();
  for (std::size_t K = 0; K < Size; ++K) {
    const double T = (static_cast<double>(K) + 0.5) / Size;
    const auto At =
        static_cast<std::size_t>(T * static_cast<double>(Values.size()));
    Book[K] = 0.5 * Values[At] + 0.5 * (Low + T * (High - Low));
  }
  for (int Round = 0; Round < 20; ++Round) {
    bool Changed = false;
    std::size_t First = 0;
    for (std::size_t K = 0; K < Size; ++K) {
      const std::size_t End =
          K + 1 == Size
              ? Values.size()
              : static_cast<std::size_t>(
                    std::lower_bound(
                        Values.begin() + static_cast<std::ptrdiff_t>(First),
                        Values.end(), 0.5 * (Book[K] + Book[K + 1])) -
                    Values.begin());
      if (End > First) {
        const double Mean =
            (Sums[End] - Sums[First]) / static_cast<double>(End - First);
        Changed = Changed || Mean != Book[K];
        Book[K] = Mean;
      }
      First = End;
    }
    if (!Changed)
      break;
  }
  std::sort(Book.begin(), Book.end());
  return Book;
}

uint8_t nearestIn(const std::vector<double> &Book, double Value) {
  const auto Above = std::lower_bound(Book.begin(), Book.end(), Value);
  auto Nearest = Above == Book.end() ? Above - 1 : Above;
  if (Above != Book.begin() && Above != Book.end() &&
      Value - *(Above - 1) <= *Above - Value)
    Nearest = Above - 1;
  return static_cast<uint8_t>(Nearest - Book.begin());
}

namespace {

/// Divides vectors into groups.
class Splitter {
public:
  Splitter(const std::vector<float> &Vectors, std::size_t Each)
      : Vectors(Vectors), Each(Each), Order(Vectors.size() / Each) {
    for (std::size_t I = 0; I < Order.size(); ++I)
      Order[I] = static_cast<uint32_t>(I);
  }

  VectorPalette split(std::size_t Most);

private:
  struct Group {
    double Squares = 0;             ///< about the mean, of all numbers
    std::size_t First = 0, End = 0; ///< of Order
    std::size_t Widest = 0; ///< the number with the largest sum of squares
    std::vector<double> Mean;

    /// The worst first; of equal ones the one that begins first.
    bool operator<(const Group &Other) const {
      return std::pair(Squares, Other.First) < std::pair(Other.Squares, First);
    }
  };

  const float *vectorAt(uint32_t I) const { return &Vectors[I * Each]; }
  Group groupOf(std::size_t First, std::size_t End) const;
  /// Puts those of \p G for which \p IsFirst holds first, and both parts in
  /// their order; where the second begins.
  template <typename Rule> std::size_t parted(const Group &G, Rule IsFirst);
  /// Where \p G is divided, after its part of Order is in two halves.
  std::size_t divide(const Group &G);

  const std::vector<float> &Vectors;
  std::size_t Each;
  std::vector<uint32_t> Order;
  std::vector<uint32_t> Second; ///< of parted()
};

Splitter::Group Splitter::groupOf(std::size_t First, std::size_t End) const {
  Group G;
  G.First = First;
  G.End = End;
  G.Mean.resize(Each);
  const auto Count = static_cast<double>(End - First);
  for (std::size_t I = First; I < End; ++I)
    for (std::size_t K = 0; K < Each; ++K)
      G.Mean[K] += vectorAt(Order[I])[K];
  for (double &M : G.Mean)
    M /= Count;
  std::vector<double> Squares(Each);
  for (std::size_t I = First; I < End; ++I)
    for (std::size_t K = 0; K < Each; ++K) {
      const double D = vectorAt(Order[I])[K] - G.Mean[K];
      Squares[K] += D * D;
    }
  for (const double S : Squares)
    G.Squares += S;
  G.Widest = static_cast<std::size_t>(
      std::max_element(Squares.begin(), Squares.end()) - Squares.begin());
  return G;
}

template <typename Rule>
std::size_t Splitter::parted(const Group &G, Rule IsFirst) {
  std::size_t To = G.First;
  Second.clear();
  for (std::size_t I = G.First; I < G.End; ++I)
    if (IsFirst(Order[I]))
      Order[To++] = Order[I];
    else
      Second.push_back(Order[I]);
  std::copy(Second.begin(), Second.end(),
            Order.begin() + static_cast<std::ptrdiff_t>(To));
  return To;
}

std::size_t Splitter::divide(const Group &G) {
  std::size_t Middle = parted(
      G, [&](uint32_t I) { return vectorAt(I)[G.Widest] <= G.Mean[G.Widest]; });
  // Two rounds of 2-means: nearer to which half's mean?
  for (int Round = 0; Round < 2; ++Round) {
    if (Middle == G.First || Middle == G.End)
      break;
    std::vector<double> Means[2];
    for (const int Half : {0, 1}) {
      Means[Half].resize(Each);
      const std::size_t From = Half == 0 ? G.First : Middle,
                        To = Half == 0 ? Middle : G.End;
      for (std::size_t I = From; I < To; ++I)
        for (std::size_t K = 0; K < Each; ++K)
          Means[Half][K] += vectorAt(Order[I])[K];
      for (double &M : Means[Half])
        M /= static_cast<double>(To - From);
    }
    double Threshold = 0;
    for (std::size_t K = 0; K < Each; ++K)
      Threshold += Means[1][K] * Means[1][K] - Means[0][K] * Means[0][K];
    Middle = parted(G, [&](uint32_t I) {
      double Along = 0;
      for (std::size_t K = 0; K < Each; ++K)
        Along += 2 * vectorAt(I)[K] * (Means[1][K] - Means[0][K]);
      return Along <= Threshold;
    });
  }
  // Of nearly equal vectors rounding may put all on one side.
  return Middle == G.First || Middle == G.End ? (G.First + G.End) / 2 : Middle;
}

VectorPalette Splitter::split(std::size_t Most) {
  std::priority_queue<Group> Left;
  Left.push(groupOf(0, Order.size()));
  std::vector<Group> Done;
  while (!Left.empty() && Left.size() + Done.size() < Most) {
    Group G = Left.top();
    Left.pop();
    if (!(G.Squares > 0)) {
      Done.push_back(std::move(G));
      continue;
    }
    const std::size_t Middle = divide(G);
    Left.push(groupOf(G.First, Middle));
    Left.push(groupOf(Middle, G.End));
  }
  for (; !Left.empty(); Left.pop())
    Done.push_back(Left.top());
  // In the order of their first vectors, which are neighbours in space.
  std::sort(Done.begin(), Done.end(),
            [&](const Group &A, const Group &B) { return A.First < B.First; });
  VectorPalette P;
  P.Labels.resize(Order.size());
  for (std::size_t N = 0; N < Done.size(); ++N) {
    for (const double M : Done[N].Mean)
      P.Entries.push_back(static_cast<float>(M));
    for (std::size_t I = Done[N].First; I < Done[N].End; ++I)
      P.Labels[Order[I]] = static_cast<uint32_t>(N);
  }
  return P;
}

} // namespace

VectorPalette paletteOf(const std::vector<float> &Vectors, std::size_t Each,
                        std::size_t Most) {
  assert(!Vectors.empty() && Vectors.size() % Each == 0);
  if (Vectors.size() / Each <= Most) {
    VectorPalette P{Vectors, {}};
    for (std::size_t I = 0; I < Vectors.size() / Each; ++I)
      P.Labels.push_back(static_cast<uint32_t>(I));
    return P;
  }
  return Splitter(Vectors, Each).split(Most);
}

} // namespace vorion::splat
