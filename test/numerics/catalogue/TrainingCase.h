/// The catalogue's part for training: scenes whose gradients are hard for
/// fp32, steps of the optimiser and losses at the ends of the range
/// (docs/numerics.md, "Catalogue of hard cases").
#pragma once

#include "device/Launcher.h"
#include "picture/Options.h"

#include <functional>
#include <string>
#include <vector>

namespace vorion::test {

/// What came out, and whether the contract is kept.
struct Finding {
  double Error = 0; ///< the worst part of its bound's kind
  double Bound = 0;
  std::string Broken; ///< what the contract says otherwise; empty: kept
};

struct TrainingCase {
  std::string Name, Why;
  std::string Contract; ///< in words, for the table
  /// Runs with the launcher's kernels.
  std::function<Expected<Finding>(splat::Launcher &, splat::Path)> Run;
  /// Names of \c brokenKernels that this case must notice, on each path that
  /// they are in.
  std::vector<std::string> FoundIn{};
  /// Whether blending takes part; what both paths share runs once.
  bool Blends = true;
};

/// All of them, in the order of the documentation.
std::vector<TrainingCase> trainingCases();

/// \name Parts of \c trainingCases
/// @{
void addGradients(std::vector<TrainingCase> &Cases);
void addSteps(std::vector<TrainingCase> &Cases);
/// @}

} // namespace vorion::test
