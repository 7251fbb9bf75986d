/// Comparison of machines, and the effects of their parameters.
#pragma once

#include "explore/Space.h"
#include "explore/Workload.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace vorion::splat {

/// The rate and energy of a machine for one kind of work.
struct Speed {
  double Rate = 0;   ///< per second, sequentially; higher is better
  double Joules = 0; ///< of the chip, per frame or iteration
};

/// The figures of a machine over a workload, by which machines are compared.
struct Figures {
  /// By kind of work in the workload, in the order of AllWork.
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

/// At least \p Count indices in \p All: the front, then the front of the
/// others, and so on.
std::vector<std::size_t> bestFronts(std::span<const Figures> All,
                                    std::size_t Count);

/// Spearman's rank correlation of at least two pairs of values. Equal values
/// have the mean of their ranks. 0 if all values of \p A or of \p B are equal.
double rankCorrelation(std::span<const double> A, std::span<const double> B);

/// An interaction: two values of different parameters whose joint effect
/// differs from the product of their single effects.
struct Interaction {
  std::size_t First, FirstValue;   ///< index of the parameter, and a choice
  std::size_t Second, SecondValue; ///< other than 0
  double Factor; ///< of the rate, divided by the product of both effects
  double Error;  ///< standard error of the factor's logarithm
};

/// The interactions whose factor differs from 1 by more than 1 %, at a
/// significance level at which chance shows one in at most one of a hundred
/// studies; the strongest first. \p Rates are those of the random \p Machines.
/// First, the effects of single values are removed from the logarithms. A pair
/// is then estimated from the four groups of machines with one, the other, both
/// or none of its values, each of at least eight machines.
std::vector<Interaction> interactions(const Space &S,
                                      std::span<const Choices> Machines,
                                      std::span<const double> Rates);

} // namespace vorion::splat
