/// Which machines are worth having, and what their parameters are worth.
#pragma once

#include "explore/Space.h"
#include "explore/Workload.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vorion::splat {

/// How fast a machine does one kind of work, and what that takes.
struct Speed {
  double Rate = 0;   ///< a second, one after the other; more is better
  double Joules = 0; ///< of the chip, for one
};

/// What a machine is judged by, over all of a workload.
struct Figures {
  /// By kind of work, in the order of AllWork: of what the workload has.
  std::array<std::optional<Speed>, AllWork.size()> Speeds;
  double Area = 0; ///< of the chip, mm2

  std::optional<Speed> &of(Work W) { return Speeds[std::size_t(W)]; }
  const std::optional<Speed> &of(Work W) const {
    return Speeds[std::size_t(W)];
  }
};

/// Indices in \p All of the Pareto-optimal machines: no other machine is at
/// least as good in every figure and better in one. Sorted by descending rate
/// of the first kind of work that the figures have. Only the first of equal
/// machines is included, unless \p KeepsEqual. All figures must be of the same
/// kinds of work.
std::vector<std::size_t> paretoFront(std::span<const Figures> All,
                                     bool KeepsEqual = false);

/// At least \p Count places in \p All: the front, then the front of the others,
/// and so on.
std::vector<std::size_t> bestFronts(std::span<const Figures> All,
                                    std::size_t Count);

/// Spearman's rank correlation, equal values having the mean of their ranks;
/// \p A and \p B are of the same two or more things. 0 where all of one are
/// equal.
double rankCorrelation(std::span<const double> A, std::span<const double> B);

/// Two values of different parameters that together are worth something else
/// than each alone would say.
struct Interaction {
  std::size_t First, FirstValue;   ///< place among the parameters, and a choice
  std::size_t Second, SecondValue; ///< that is not 0
  double Factor; ///< of the rate, beyond the product of both effects
  double Error;  ///< standard error of the factor's logarithm
};

/// Those whose factor is further from 1 than 1 %, and so far that chance shows
/// such a pair in no more than one study of a hundred; the strongest first. \p
/// Rates are those of \p Machines, which were drawn at random. The effects of
/// single values are taken out of the logarithms first; a pair is told by the
/// four groups of machines that have one, the other, both or none of its
/// values, of eight machines at least.
std::vector<Interaction> interactions(const Space &S,
                                      std::span<const Choices> Machines,
                                      std::span<const double> Rates);

} // namespace vorion::splat
