/// The catalogue's part for training: scenes whose gradients are hard for
/// fp32, steps of the optimiser and losses at the ends of the range, methods of
/// training; and what else has a judge of its own (docs/hard-cases.md).
#pragma once

#include "device/Launcher.h"
#include "render/Backward.h"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace vorion::test {

/// What came out, and whether the contract is kept.
struct Finding {
  double Error = 0; ///< the worst part of its bound's kind
  double Bound = 0;
  std::string Broken; ///< what the contract says otherwise; empty: kept
};

/// By what gradients are taken back: a path and, of the cores, how they add up
/// pixels.
struct Way {
  splat::Path Blending;
  splat::SimtSums Sums = splat::SimtSums::Ordered;
};

/// The word that says which it is: "raster", "simt", "atomics", "warp".
std::string_view name(const Way &W);

struct TrainingCase {
  std::string Name, Why;
  std::string Contract; ///< in words, for the table
  /// Runs with the launcher's kernels.
  std::function<Expected<Finding>(splat::Launcher &, const Way &)> Run;
  /// Names of \c brokenKernels that this case must notice, in each way that
  /// they are in.
  std::vector<std::string> FoundIn{};
  /// Whether blending takes part; what both paths share runs once.
  bool Blends = true;
  /// The path that has it; both where not given.
  std::optional<splat::Path> Only{};
  /// Whether gradients are taken back: then by each way.
  bool GoesBack = false;
};

/// The ways in which a case runs.
std::vector<Way> waysOf(const TrainingCase &C);

/// One in which no picture is blended.
TrainingCase withoutBlending(const char *Name, const char *Why,
                             std::string Contract,
                             Expected<Finding> (*Run)(splat::Launcher &),
                             std::vector<std::string> FoundIn);

/// Holds numbers against what they should be, and keeps the worst of them.
class Worst {
public:
  explicit Worst(double Bound) { F.Bound = Bound; }

  /// \p Is of \p What, in parts of \p Unit. What is not a number is worst.
  void take(std::string_view What, double Is, double Want, double Unit);
  /// Something that is no number.
  void demand(bool Holds, std::string What) {
    if (!Holds && F.Broken.empty())
      F.Broken = std::move(What);
  }
  Expected<Finding> finding(const splat::Launcher &L) const {
    if (L.failure())
      return *L.failure();
    return F;
  }

private:
  Finding F;
};

/// All of them, in the order of the documentation.
std::vector<TrainingCase> trainingCases();

/// \name Parts of \c trainingCases
/// @{
void addRayOrders(std::vector<TrainingCase> &Cases);
void addRays(std::vector<TrainingCase> &Cases);
void addGradients(std::vector<TrainingCase> &Cases);
void addSteps(std::vector<TrainingCase> &Cases);
void addDensity(std::vector<TrainingCase> &Cases);
void addMethods(std::vector<TrainingCase> &Cases);
void addMethodGradients(std::vector<TrainingCase> &Cases);
void addMeshes(std::vector<TrainingCase> &Cases);
/// @}

} // namespace vorion::test
