/// Density control: the action for each Gaussian.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace vorion::reference {

enum class Fate : uint8_t { Drop, Keep, Clone, Split };

/// Number of Gaussians that result from an action.
constexpr std::size_t becomes(Fate F) {
  return F == Fate::Drop ? 0 : F == Fate::Keep ? 1 : 2;
}

/// Criteria for one Gaussian.
struct DensityFacts {
  double Gradient = 0; ///< mean over the views that saw it, half pictures
  double Scale = 0;    ///< of its longest axis
  double Opacity = 0;
  double Radius = 0; ///< px, largest
};

struct DensityRule {
  double Gradient = 2e-4;      ///< grows above
  double SplitScale = 0;       ///< splits rather than clones above
  double SplitShrink = 1.6;    ///< a half's scale: over this
  double LeastOpacity = 0.005; ///< dropped below
  double MostScale = 0;        ///< dropped above; infinite: never
  double MostRadius = 0;       ///< dropped above; infinite: never
  std::size_t MostGaussians = 0;
};

/// Actions by Kerbl et al. 2023: cloning and splitting first, then pruning of
/// the result (the parts of a split have no radius yet). If more than
/// MostGaussians would remain, those with the largest gradients are densified,
/// ties by index, and the others are kept unchanged.
std::vector<Fate> fatesOf(const std::vector<DensityFacts> &Gaussians,
                          const DensityRule &Rule);

} // namespace vorion::reference
