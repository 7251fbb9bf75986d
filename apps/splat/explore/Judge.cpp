#include "explore/Judge.h"

#include "io/Mean.h"
#include "study/ParetoFront.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numeric>
#include <tuple>

namespace vorion::splat {

namespace {

/// Each is better if it is less. Work that there is not is equal on all.
using Criteria = std::array<double, 2 * AllWork.size() + 1>;

Criteria criteriaOf(const Figures &F) {
  Criteria All{};
  std::size_t I = 0;
  for (const auto &S : F.Speeds) {
    All[I++] = S ? -S->Rate : 0;
    All[I++] = S ? S->Joules : 0;
  }
  All[I] = F.Area;
  return All;
}

bool isAsGood(const Criteria &A, const Criteria &B) {
  return std::ranges::equal(A, B, std::less_equal<>());
}

std::vector<Criteria> criteriaOf(std::span<const Figures> All) {
  std::vector<Criteria> Each;
  Each.reserve(All.size());
  for (const Figures &F : All)
    Each.push_back(criteriaOf(F));
  return Each;
}

std::vector<std::size_t> places(std::size_t Count) {
  std::vector<std::size_t> All(Count);
  std::iota(All.begin(), All.end(), std::size_t{0});
  return All;
}

/// The front of \p Among, which are places in \p All in their order. Of equal
/// ones the first, unless \p KeepsEqual.
std::vector<std::size_t> frontOf(std::span<const Criteria> All,
                                 std::vector<std::size_t> Among,
                                 bool KeepsEqual = false) {
  std::ranges::sort(Among, {},
                    [&](std::size_t I) { return std::tuple(All[I], I); });
  std::vector<std::size_t> Front =
      paretoFront(Among, [&](std::size_t A, std::size_t B) {
        return isAsGood(All[A], All[B]) && !(KeepsEqual && All[A] == All[B]);
      });
  // Rates are negative here, and those of work that there is not are 0.
  std::ranges::sort(Front, {}, [&](std::size_t I) {
    return std::tuple(All[I][0], All[I][2], I);
  });
  return Front;
}

std::vector<double> ranks(std::span<const double> Of) {
  std::vector<std::size_t> Order = places(Of.size());
  std::ranges::sort(Order, {}, [&](std::size_t I) { return Of[I]; });
  std::vector<double> Ranks(Of.size());
  for (std::size_t From = 0, To = 0; From < Order.size(); From = To) {
    while (To < Order.size() && Of[Order[To]] == Of[Order[From]])
      ++To;
    for (std::size_t I = From; I < To; ++I)
      Ranks[Order[I]] = static_cast<double>(From + To - 1) / 2;
  }
  return Ranks;
}

/// Of a factor's logarithm: less is not worth a row.
constexpr double LeastInteraction = 0.01;
/// Of fewer values a standard error is little known.
constexpr std::size_t LeastInGroup = 8;
/// How likely it may be that any of all pairs is found by chance alone.
constexpr double MayBeChance = 0.01;

/// Standard errors that none of \p Count normal values exceeds, but with that
/// probability: P(|Z| > z) <= exp(-z^2 / 2).
double errorsFor(std::size_t Count) {
  return std::sqrt(2 * std::log(static_cast<double>(Count) / MayBeChance));
}

/// Values of some machines.
struct Group {
  std::vector<double> Values;

  double mean() const { return meanOf(Values); }
  /// The variance of mean().
  double variance() const {
    const double Mean = mean();
    double Sum = 0;
    for (const double V : Values)
      Sum += (V - Mean) * (V - Mean);
    const auto N = static_cast<double>(Values.size());
    return Sum / (N - 1) / N;
  }
};

/// The logarithms of \p Rates without their mean and without what each value of
/// each parameter adds, by least squares.
std::vector<double> withoutSingleEffects(const Space &S,
                                         std::span<const Choices> Machines,
                                         std::span<const double> Rates) {
  std::vector<double> Left;
  Left.reserve(Rates.size());
  for (const double Rate : Rates)
    Left.push_back(std::log(Rate));
  // Effects of other parameters are not quite balanced in a random sample, so
  // that taking out one changes what is left of another: some rounds.
  for (int Round = 0; Round < 20; ++Round)
    for (std::size_t P = 0; P < S.size(); ++P)
      for (std::size_t Value = 0; Value <= S[P].Others.size(); ++Value) {
        Group With;
        for (std::size_t M = 0; M < Machines.size(); ++M)
          if (Machines[M][P] == Value)
            With.Values.push_back(Left[M]);
        if (With.Values.empty())
          continue;
        const double Mean = With.mean();
        for (std::size_t M = 0; M < Machines.size(); ++M)
          if (Machines[M][P] == Value)
            Left[M] -= Mean;
      }
  return Left;
}

} // namespace

std::vector<std::size_t> paretoFront(std::span<const Figures> All,
                                     bool KeepsEqual) {
  return frontOf(criteriaOf(All), places(All.size()), KeepsEqual);
}

std::vector<std::size_t> bestFronts(std::span<const Figures> All,
                                    std::size_t Count) {
  const std::vector<Criteria> Each = criteriaOf(All);
  std::vector<std::size_t> Left = places(All.size()), Best;
  while (Best.size() < Count && !Left.empty()) {
    const std::vector<std::size_t> Front = frontOf(Each, Left);
    Best.insert(Best.end(), Front.begin(), Front.end());
    std::erase_if(Left, [&](std::size_t I) {
      return std::ranges::find(Front, I) != Front.end();
    });
  }
  return Best;
}

double rankCorrelation(std::span<const double> A, std::span<const double> B) {
  const std::vector<double> RanksA = ranks(A), RanksB = ranks(B);
  const double Mean = meanOf(RanksA); // of both
  double Both = 0, OfA = 0, OfB = 0;
  for (std::size_t I = 0; I < A.size(); ++I) {
    Both += (RanksA[I] - Mean) * (RanksB[I] - Mean);
    OfA += (RanksA[I] - Mean) * (RanksA[I] - Mean);
    OfB += (RanksB[I] - Mean) * (RanksB[I] - Mean);
  }
  return OfA > 0 && OfB > 0 ? Both / std::sqrt(OfA * OfB) : 0;
}

std::vector<Interaction> interactions(const Space &S,
                                      std::span<const Choices> Machines,
                                      std::span<const double> Rates) {
  if (Machines.empty())
    return {};
  const std::vector<double> Left = withoutSingleEffects(S, Machines, Rates);
  std::vector<Interaction> Judged;
  const auto Judge = [&](Interaction Of) {
    // By whether a machine has the first value, and the second.
    std::array<std::array<Group, 2>, 2> Groups;
    for (std::size_t M = 0; M < Machines.size(); ++M) {
      const std::size_t A = Machines[M][Of.First], B = Machines[M][Of.Second];
      if ((A == 0 || A == Of.FirstValue) && (B == 0 || B == Of.SecondValue))
        Groups[A != 0][B != 0].Values.push_back(Left[M]);
    }
    double Sum = 0, Variance = 0;
    for (std::size_t A = 0; A < 2; ++A)
      for (std::size_t B = 0; B < 2; ++B) {
        if (Groups[A][B].Values.size() < LeastInGroup)
          return;
        Sum += (A == B ? 1 : -1) * Groups[A][B].mean();
        Variance += Groups[A][B].variance();
      }
    Of.Factor = std::exp(Sum);
    Of.Error = std::sqrt(Variance);
    Judged.push_back(Of);
  };
  for (std::size_t P = 0; P < S.size(); ++P)
    for (std::size_t Q = P + 1; Q < S.size(); ++Q)
      for (std::size_t I = 1; I <= S[P].Others.size(); ++I)
        for (std::size_t J = 1; J <= S[Q].Others.size(); ++J)
          Judge({P, I, Q, J, 1, 0});
  const double Errors = errorsFor(Judged.size());
  std::erase_if(Judged, [&](const Interaction &I) {
    return std::abs(std::log(I.Factor)) <=
           std::max(Errors * I.Error, LeastInteraction);
  });
  std::ranges::sort(Judged, {}, [](const Interaction &I) {
    return std::tuple(-std::abs(std::log(I.Factor)), I.First, I.Second,
                      I.FirstValue, I.SecondValue);
  });
  return Judged;
}

} // namespace vorion::splat
